# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# hapnet_page(OUT): the files of web/page and its modules are compiled into hapnet-web. Sets OUT to
# the source that has them. Without modules the page draws flat; that is no error.
set(HAPNET_PAGE_MODULES "" CACHE PATH
    "A node_modules folder with three and uplot; empty: npm ci fetches them into the build folder")

# hapnet_page_modules(OUT): the folder of the modules; empty when they cannot be had.
function(hapnet_page_modules out)
    set(${out} "${HAPNET_PAGE_MODULES}" PARENT_SCOPE)
    set(lock ${PROJECT_SOURCE_DIR}/web/page/package-lock.json)
    if(HAPNET_PAGE_MODULES OR NOT EXISTS ${lock})
        return()
    endif()
    set(folder ${PROJECT_BINARY_DIR}/page_modules)
    file(SHA256 ${lock} hash)
    if(EXISTS ${folder}/${hash})
        set(${out} ${folder}/node_modules PARENT_SCOPE)
        return()
    endif()
    find_program(HAPNET_NPM npm)
    set(result "npm is missing: scripts/setup.sh --web installs it")
    if(HAPNET_NPM)
        file(MAKE_DIRECTORY ${folder})
        file(COPY ${lock} ${PROJECT_SOURCE_DIR}/web/page/package.json DESTINATION ${folder})
        execute_process(COMMAND ${HAPNET_NPM} ci --omit=dev --ignore-scripts --no-audit --no-fund
            WORKING_DIRECTORY ${folder} RESULT_VARIABLE result TIMEOUT 120
            OUTPUT_QUIET ERROR_QUIET)
    endif()
    if(result STREQUAL "0")
        file(TOUCH ${folder}/${hash})
        set(${out} ${folder}/node_modules PARENT_SCOPE)
    else()
        message(WARNING "hapnet-web's page will draw flat, without its modules (${result})")
    endif()
endfunction()

function(hapnet_page out)
    set(page ${PROJECT_SOURCE_DIR}/web/page)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${page}
        ${page}/*.html ${page}/*.css ${page}/*.js ${page}/*.svg)
    list(FILTER files EXCLUDE REGEX "^node_modules/")
    set(entries)
    foreach(file IN LISTS files)
        list(APPEND entries "${file}=${page}/${file}")
    endforeach()
    hapnet_page_modules(modules)
    foreach(pair three.module.min.js=three/build/three.module.min.js
                 three.core.min.js=three/build/three.core.min.js
                 three-LICENSE.txt=three/LICENSE
                 uPlot.iife.min.js=uplot/dist/uPlot.iife.min.js
                 uPlot.min.css=uplot/dist/uPlot.min.css
                 uplot-LICENSE.txt=uplot/LICENSE)
        string(REGEX MATCH "^([^=]+)=(.+)$" matched ${pair})
        if(modules AND EXISTS ${modules}/${CMAKE_MATCH_2})
            list(APPEND entries "${CMAKE_MATCH_1}=${modules}/${CMAKE_MATCH_2}")
        endif()
    endforeach()
    find_program(HAPNET_GZIP gzip)
    find_program(HAPNET_SED sed)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/page)
    set(strip ${PROJECT_SOURCE_DIR}/cmake/strip_comments.sed)
    set(code "") # in assembler: the bytes as they are
    set(table "")
    set(depends)
    set(number 0)
    foreach(entry IN LISTS entries)
        string(REGEX MATCH "^([^=]+)=(.+)$" matched ${entry})
        set(name ${CMAKE_MATCH_1})
        set(file ${CMAKE_MATCH_2})
        # A browser has no use for comments, and they were 10 kB of what it has to load.
        if(HAPNET_SED AND file MATCHES "^${page}/.*[.](js|css)$")
            set(stripped ${folder}/${number}-stripped)
            add_custom_command(OUTPUT ${stripped} DEPENDS ${file} ${strip}
                COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
                COMMAND ${HAPNET_SED} -f ${strip} ${file} > ${stripped} VERBATIM)
            set(file ${stripped})
        endif()
        set(packed ${folder}/${number}.gz)
        if(HAPNET_GZIP)
            add_custom_command(OUTPUT ${packed} DEPENDS ${file}
                COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
                COMMAND ${HAPNET_GZIP} -9 -n -c ${file} > ${packed} VERBATIM)
            list(APPEND depends ${packed})
        endif()
        list(APPEND depends ${file})
        foreach(kind raw packed)
            set(source ${file})
            if(kind STREQUAL "packed") # quoted: there is a variable of that name
                set(source ${packed})
            endif()
            set(incbin "\\t.incbin \\\"${source}\\\"\\n")
            if(kind STREQUAL "packed" AND NOT HAPNET_GZIP)
                set(incbin "")
            endif()
            string(APPEND code "    \"page_${kind}_${number}:\\n${incbin}"
                "page_${kind}_${number}_end:\\n\\t.byte 0\\n\"\n")
            string(APPEND declared "extern const char page_${kind}_${number}[], "
                "page_${kind}_${number}_end[];\n")
        endforeach()
        string(APPEND table "        Asset{\"${name}\", between(page_raw_${number}, "
            "page_raw_${number}_end), "
            "between(page_packed_${number}, page_packed_${number}_end)},\n")
        math(EXPR number "${number} + 1")
    endforeach()
    set(source ${CMAKE_CURRENT_BINARY_DIR}/page_assets.cpp)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/page_assets.cpp.in ${source} @ONLY)
    set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${depends}")
    set(${out} ${source} PARENT_SCOPE)
endfunction()

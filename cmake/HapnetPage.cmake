# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The files of web/page, compiled into the programs that show them: hapnet-web serves them, and
# results of hapnet-emulator and hapnet-lab carry what draws them. Worlds are drawn in space by
# Debian's three.js, and are still pictures without it; no page needs npm.
set(hapnet_page_folder ${PROJECT_SOURCE_DIR}/web/page)
set(hapnet_debian_three /usr/share/javascript/three/three.min.js)

# hapnet_page_module(OUT NAME SCRIPT CODE): a classic script as a module, by a line of code at its
# end.
function(hapnet_page_module out name script code)
    set(module ${PROJECT_BINARY_DIR}/${name})
    file(READ ${script} text)
    file(CONFIGURE OUTPUT ${module} CONTENT "${text}\n${code}\n" @ONLY)
    set(${out} "${name}=${module}" PARENT_SCOPE)
endfunction()

# hapnet_page_libraries(OUT): what pages take of others, as name=file: Debian's three.js, of which
# the module has what the painters name.
function(hapnet_page_libraries out)
    set(entries)
    if(EXISTS ${hapnet_debian_three})
        set(names REVISION)
        file(GLOB painters CONFIGURE_DEPENDS ${hapnet_page_folder}/paint/*.js)
        foreach(painter IN LISTS painters)
            file(READ ${painter} text)
            string(REGEX MATCHALL "three[.][A-Z][A-Za-z0-9]+" found "${text}")
            list(TRANSFORM found REPLACE "three[.]" "")
            list(APPEND names ${found})
        endforeach()
        list(REMOVE_DUPLICATES names)
        list(JOIN names ", " names)
        file(READ ${PROJECT_SOURCE_DIR}/cmake/debian_three.js.in code)
        string(CONFIGURE "${code}" code @ONLY)
        hapnet_page_module(module three.module.min.js ${hapnet_debian_three} "${code}")
        list(APPEND entries ${module} three-LICENSE.txt=/usr/share/doc/libjs-three/copyright)
    else()
        get_property(was_said GLOBAL PROPERTY hapnet_page_still)
        if(NOT was_said)
            message(WARNING "Pages will not draw worlds: Debian's package libjs-three is missing")
            set_property(GLOBAL PROPERTY hapnet_page_still TRUE)
        endif()
    endif()
    set(${out} ${entries} PARENT_SCOPE)
endfunction()

# hapnet_page_files(OUT PATTERN): the files of the page itself whose names match, as name=file.
function(hapnet_page_files out pattern)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${hapnet_page_folder}
        ${hapnet_page_folder}/*.html ${hapnet_page_folder}/*.css ${hapnet_page_folder}/*.js
        ${hapnet_page_folder}/*.svg)
    list(FILTER files INCLUDE REGEX "${pattern}")
    set(entries)
    foreach(file IN LISTS files)
        list(APPEND entries "${file}=${hapnet_page_folder}/${file}")
    endforeach()
    set(${out} ${entries} PARENT_SCOPE)
endfunction()

# hapnet_page(OUT HEADER header NAMESPACE namespace FUNCTION function [PLAIN name=file...]
# [PACKED name=file...]): a source with that function, whose list of {name, bytes, packed} has the
# files as they are, packed by gzip, or both; what is not wanted is empty. Several files with | in
# between are joined. The type of the items is Asset; HEADER declares it and the function. Sets OUT
# to the source.
function(hapnet_page out)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "HEADER;NAMESPACE;FUNCTION" "PLAIN;PACKED")
    set(header ${arg_HEADER})
    set(namespace ${arg_NAMESPACE})
    set(function ${arg_FUNCTION})
    find_program(HAPNET_GZIP gzip)
    find_program(HAPNET_SED sed)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/page)
    set(strip ${PROJECT_SOURCE_DIR}/cmake/strip_comments.sed)
    set(join ${PROJECT_SOURCE_DIR}/cmake/join_lines.sed)
    set(code "") # in assembler: the bytes as they are
    set(declared "")
    set(table "")
    set(depends)
    set(number 0)
    set(entries ${arg_PLAIN} ${arg_PACKED})
    list(REMOVE_DUPLICATES entries)
    if(HAPNET_TIDY) # reads no bytes, and would first build all that the commands below come after
        set(entries "LICENSE=${PROJECT_SOURCE_DIR}/LICENSE")
    endif()
    foreach(entry IN LISTS entries)
        string(REGEX MATCH "^([^=]+)=(.+)$" matched ${entry})
        set(name ${CMAKE_MATCH_1})
        string(REPLACE "|" ";" file ${CMAKE_MATCH_2})
        # A browser has no use for comments, and they were 10 kB of what it has to load.
        if(HAPNET_SED AND name MATCHES "[.](js|css|html)$" AND NOT name MATCHES "[.]min[.]")
            set(stripped ${folder}/${number}-stripped)
            set(join_lines)
            if(NOT name MATCHES "[.]html$")
                set(join_lines COMMAND ${HAPNET_SED} -z -i -f ${join} ${stripped})
            endif()
            add_custom_command(OUTPUT ${stripped} DEPENDS ${file} ${strip} ${join}
                COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
                COMMAND ${HAPNET_SED} -f ${strip} ${file} > ${stripped} ${join_lines} VERBATIM)
            set(file ${stripped})
        elseif(name MATCHES "[.]css$")
            add_custom_command(OUTPUT ${folder}/${number}-joined DEPENDS ${file}
                COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
                COMMAND ${CMAKE_COMMAND} -E cat ${file} > ${folder}/${number}-joined VERBATIM)
            set(file ${folder}/${number}-joined)
        endif()
        set(packed ${folder}/${number}.gz)
        if(HAPNET_GZIP AND entry IN_LIST arg_PACKED)
            add_custom_command(OUTPUT ${packed} DEPENDS ${file}
                COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
                COMMAND ${HAPNET_GZIP} -9 -n -c ${file} > ${packed} VERBATIM)
            list(APPEND depends ${packed})
        endif()
        list(APPEND depends ${file})
        foreach(kind raw packed)
            set(incbin "")
            if(kind STREQUAL "raw" AND entry IN_LIST arg_PLAIN)
                set(incbin "\\t.incbin \\\"${file}\\\"\\n")
            elseif(kind STREQUAL "packed" AND HAPNET_GZIP AND entry IN_LIST arg_PACKED)
                set(incbin "\\t.incbin \\\"${packed}\\\"\\n")
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
    set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${depends}"
        SKIP_UNITY_BUILD_INCLUSION ON)
    set(${out} ${source} PARENT_SCOPE)
endfunction()

# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# hapnet_schemas(OUT HEADER ... NAMESPACE ... FILES NAME=FILE ...): the JSON Schemas of
# docs/formats/schemas that a program carries with it. Writes the source of written_schemas(), which
# HEADER declares and which gives each as a cli::DocumentSchema{name, text}. Sets OUT to its path.
function(hapnet_schemas out)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "HEADER;NAMESPACE" "FILES")
    set(arg_FOLDER docs/formats/schemas)
    set(arg_TYPE cli::DocumentSchema)
    set(arg_FUNCTION written_schemas)
    set(entries)
    foreach(pair IN LISTS arg_FILES)
        string(REGEX MATCH "^([^=]+)=(.+)$" matched ${pair})
        set(file ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/${CMAKE_MATCH_2}.schema.json)
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
        set(name ${CMAKE_MATCH_1})
        file(READ ${file} text)
        string(APPEND entries "        ${arg_TYPE}{\"${name}\", R\"json(${text})json\"},\n")
    endforeach()
    set(source ${CMAKE_CURRENT_BINARY_DIR}/written_schemas.cpp)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/built_in.cpp.in ${source} @ONLY)
    set(${out} ${source} PARENT_SCOPE)
endfunction()

# hapnet_schema_files(PROGRAM): writes all schemas that it prints into schemas/ of the build, from
# where packages install them, whenever it is linked.
function(hapnet_schema_files program)
    set(folder ${PROJECT_BINARY_DIR}/schemas)
    file(MAKE_DIRECTORY ${folder})
    add_custom_command(TARGET ${program} POST_BUILD
        COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:${program}> -DOUT=${folder}
                -P ${PROJECT_SOURCE_DIR}/cmake/write_schemas.cmake)
endfunction()

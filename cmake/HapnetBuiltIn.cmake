# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# hapnet_built_in(OUT FOLDER scripts/scenes HEADER ... NAMESPACE ... TYPE ... FUNCTION ...): the
# TOML files of a folder are compiled in, so that a user has them wherever the program is. Writes
# the source of FUNCTION, which HEADER declares and which gives all of them as TYPE{name, text},
# and sets OUT to its path. Installs the files, too.
function(hapnet_built_in out)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "FOLDER;HEADER;NAMESPACE;TYPE;FUNCTION" "")
    file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${arg_FOLDER}/*.toml)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})
    set(entries)
    foreach(file IN LISTS files)
        get_filename_component(name ${file} NAME_WLE)
        file(READ ${file} text)
        string(APPEND entries "        ${arg_TYPE}{\"${name}\", R\"toml(${text})toml\"},\n")
    endforeach()
    set(source ${CMAKE_CURRENT_BINARY_DIR}/${arg_FUNCTION}.cpp)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/built_in.cpp.in ${source} @ONLY)
    get_filename_component(kind ${arg_FOLDER} NAME)
    hapnet_component(component ${kind})
    install(FILES ${files} DESTINATION ${CMAKE_INSTALL_DATADIR}/hapnet/${kind}
            COMPONENT ${component})
    set(${out} ${source} PARENT_SCOPE)
endfunction()

# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# cmake -DPROGRAM=FILE -DOUT=FOLDER -P write_schemas.cmake: writes all JSON Schemas of a program, as
# it prints them, into a folder. Statistics are called by the program: emulator.schema.json.
execute_process(COMMAND ${PROGRAM} schema --list OUTPUT_VARIABLE list COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" lines "${list}")
get_filename_component(program ${PROGRAM} NAME_WE)
string(REPLACE "hapnet-" "" program ${program})
foreach(line IN LISTS lines)
    string(REGEX MATCH "^[a-z-]+" name ${line})
    set(file ${name})
    if(name STREQUAL "statistics")
        set(file ${program})
    elseif(name STREQUAL "frame")
        set(file ${program}-frame)
    elseif(name STREQUAL "predict")
        set(file prediction)
    elseif(name STREQUAL "verify")
        set(file verification)
    endif()
    execute_process(COMMAND ${PROGRAM} schema ${name}
                    OUTPUT_FILE ${OUT}/${file}.schema.json COMMAND_ERROR_IS_FATAL ANY)
endforeach()

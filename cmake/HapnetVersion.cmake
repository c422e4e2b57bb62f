# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# Writes generated/hapnet_commit.hpp at build time, and only when the commit has changed.

if(CMAKE_SCRIPT_MODE_FILE)
    execute_process(
        COMMAND git -c safe.directory=* describe --always --dirty --abbrev=12
        WORKING_DIRECTORY ${SOURCE_DIR}
        OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    if(failed OR commit STREQUAL "")
        set(commit "unknown")
    endif()
    configure_file(${SOURCE_DIR}/cmake/hapnet_commit.hpp.in ${OUTPUT} @ONLY)
    return()
endif()

set(HAPNET_GENERATED ${PROJECT_BINARY_DIR}/generated)
add_custom_target(hapnet_commit
    COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR}
            -DOUTPUT=${HAPNET_GENERATED}/hapnet_commit.hpp
            -P ${PROJECT_SOURCE_DIR}/cmake/HapnetVersion.cmake
    BYPRODUCTS ${HAPNET_GENERATED}/hapnet_commit.hpp
    COMMENT "")

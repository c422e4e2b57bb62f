# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# hapnet_discover(PROGRAM KIND PREFIX TIMEOUT [ALL] [FILTER ...] [LIST ...] [PROPERTIES ...]): makes
# each test of a GoogleTest program a test of ctest, PREFIX followed by the name, with the label
# KIND. Instantiations with the prefix All also get the label "all", which the default run leaves
# out, and so do all tests of a program that is marked ALL. FILTER takes a part of the tests, whose
# names ctest then knows as LIST. The target default_tests builds every program that has tests in
# the default run, without those end to end.
include(GoogleTest)
add_custom_target(default_tests)
function(hapnet_discover program kind prefix timeout)
    cmake_parse_arguments(PARSE_ARGV 4 arg "ALL" "FILTER;LIST" "PROPERTIES")
    set(list ${program}_TESTS)
    if(arg_LIST)
        set(list ${arg_LIST})
    endif()
    gtest_discover_tests(${program} TEST_PREFIX ${prefix} DISCOVERY_MODE PRE_TEST
        TEST_FILTER "${arg_FILTER}" TEST_LIST ${list}
        PROPERTIES LABELS ${kind} TIMEOUT ${timeout} ${arg_PROPERTIES})
    set(only_all "^${prefix}All/")
    if(arg_ALL)
        set(only_all ".")
    elseif(NOT kind STREQUAL "e2e") # the target end_to_end builds those
        add_dependencies(default_tests ${program})
    endif()
    # Read by ctest after the list of tests. A program that is not built is one failing test there.
    set(labels ${CMAKE_CURRENT_BINARY_DIR}/${list}_labels.cmake)
    file(GENERATE OUTPUT ${labels} CONTENT "\
if(NOT EXISTS \"$<TARGET_FILE:${program}>\")
    set(${list} ${program}_NOT_BUILT)
endif()
foreach(test IN LISTS ${list})
    if(test MATCHES \"${only_all}\")
        set_tests_properties(\"\${test}\" PROPERTIES LABELS \"${kind};all\")
    endif()
endforeach()
")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${labels})
endfunction()

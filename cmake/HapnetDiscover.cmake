# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# What ctest knows of a test beside its kind, which is its first label:
#   all          the default run leaves it out
#   clock        it meets a real clock: when_quiet runs it, and repeats it when it failed while the
#                machine stood still
#   permissions  it is about what a user may do, and says less as root
include(GoogleTest)

# Tests that judge how long something took, or that start programs whose loops keep time: end to end
# all but those that start only programs without a loop.
set(hapnet_clock_tests "\
^conformance/(dhd|falcon|hdapi|hid|inverse3|omni1394)/|^e2e/|\
^unit/emulator/Workers[.]|^unit/peer/(Watchdog|WatchedRig|PlotStream)[.]|\
^unit/proto/(Clock|UdpSocket)[.]")
set(hapnet_clockless_tests "^e2e/(Keygen|LabExplain|LabReport)[.]")
set(hapnet_permission_tests "\
WithTheCureWhereThereIsNoPermission|WithoutPermissionIsListed|ThatMayNotBeOpened|\
/(KeyFiles|KeeperFolder|PeerKeys|Keygen)[.]|Controlled(Peers)?[.]Own|\
UnixListener[.]IsForItsOwner|NamesTheCureWhereUserNamespaces")

# hapnet_discover(PROGRAM KIND PREFIX TIMEOUT [ALL] [FILTER ...] [LIST ...] [PROPERTIES ...]): makes
# each test of a GoogleTest program a test of ctest, PREFIX followed by the name, with the label
# KIND. Instantiations with the prefix All also get the label "all", and so do all tests of a
# program that is marked ALL. FILTER takes a part of the tests, whose names ctest then knows as
# LIST. The target default_tests builds every program that has tests in the default run, but for
# those end to end, which the target end_to_end builds.
add_custom_target(default_tests)
function(hapnet_discover program kind prefix timeout)
    cmake_parse_arguments(PARSE_ARGV 4 arg "ALL" "FILTER;LIST" "PROPERTIES")
    set(list ${program}_TESTS)
    if(arg_LIST)
        set(list ${arg_LIST})
    endif()
    # Where programs of another machine would have their emulator. It starts the tests that meet no
    # real clock as they are.
    set_target_properties(${program} PROPERTIES
        CROSSCOMPILING_EMULATOR ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/when_quiet)
    gtest_discover_tests(${program} TEST_PREFIX ${prefix} DISCOVERY_MODE PRE_TEST
        TEST_FILTER "${arg_FILTER}" TEST_LIST ${list}
        PROPERTIES LABELS ${kind} TIMEOUT ${timeout} ${arg_PROPERTIES})
    set_target_properties(${program} PROPERTIES CROSSCOMPILING_EMULATOR "")
    add_dependencies(${program} when_quiet)
    set(only_all "^${prefix}All/")
    if(arg_ALL)
        set(only_all ".")
    elseif(NOT kind STREQUAL "e2e") # the target end_to_end builds those
        add_dependencies(default_tests ${program})
    endif()
    # Read by ctest after the list of tests. A program that is not built is one failing test.
    set(labels ${CMAKE_CURRENT_BINARY_DIR}/${list}_labels.cmake)
    file(GENERATE OUTPUT ${labels} CONTENT "\
if(NOT EXISTS \"$<TARGET_FILE:${program}>\")
    set(${list} ${program}_NOT_BUILT)
endif()
foreach(test IN LISTS ${list})
    set(labels ${kind})
    if(test MATCHES \"${only_all}\")
        list(APPEND labels all)
    endif()
    if(test MATCHES \"${hapnet_permission_tests}\")
        list(APPEND labels permissions)
    endif()
    if(test MATCHES \"${hapnet_clock_tests}\" AND NOT test MATCHES \"${hapnet_clockless_tests}\")
        list(APPEND labels clock)
        set_tests_properties(\"\${test}\" PROPERTIES SKIP_RETURN_CODE 77
            ENVIRONMENT_MODIFICATION HAPNET_CLOCK=set:${timeout})
    endif()
    set_tests_properties(\"\${test}\" PROPERTIES LABELS \"\${labels}\")
endforeach()
")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${labels})
endfunction()

# hapnet_script(NAME COMMAND ... [TIMEOUT ...] [LABELS ...] [COST ...] [ENVIRONMENT ...]
# [LOOPBACK]): a script as a test end to end, which exits with 77 where it cannot run. With the
# label clock when_quiet runs it. LOOPBACK gives it a loopback of its own.
function(hapnet_script name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "LOOPBACK" "TIMEOUT;COST" "COMMAND;LABELS;ENVIRONMENT")
    if(arg_LOOPBACK)
        list(PREPEND arg_COMMAND $<TARGET_FILE:own_loopback>)
    endif()
    if(NOT arg_TIMEOUT)
        set(arg_TIMEOUT 120)
    endif()
    if(clock IN_LIST arg_LABELS)
        list(PREPEND arg_COMMAND $<TARGET_FILE:when_quiet>)
        list(APPEND arg_ENVIRONMENT HAPNET_CLOCK=${arg_TIMEOUT})
    endif()
    add_test(NAME ${name} COMMAND ${arg_COMMAND})
    set_tests_properties(${name} PROPERTIES LABELS "e2e;${arg_LABELS}" TIMEOUT ${arg_TIMEOUT}
        SKIP_RETURN_CODE 77 ENVIRONMENT "${arg_ENVIRONMENT}")
    if(arg_COST) # begins early: it takes long
        set_tests_properties(${name} PROPERTIES COST ${arg_COST})
    endif()
endfunction()

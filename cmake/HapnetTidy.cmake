# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The target `tidy`: clang-tidy over everything but the tests, in five units. It matches all that a
# unit includes, the headers of libraries too, and begins anew with every unit: JSON alone takes
# seconds of each. Nothing is compiled: the presets that test do that.
find_program(HAPNET_CLANG_TIDY clang-tidy-14 REQUIRED)

# hapnet_tidy_unit(NAME TARGET ...): the sources of some targets are read as one file.
function(hapnet_tidy_unit name)
    add_library(${name} OBJECT EXCLUDE_FROM_ALL)
    target_link_libraries(${name} PRIVATE hapnet_options)
    foreach(target IN LISTS ARGN)
        get_target_property(sources ${target} SOURCES)
        get_target_property(folder ${target} SOURCE_DIR)
        list(FILTER sources INCLUDE REGEX [[\.cpp$]])
        foreach(source IN LISTS sources)
            cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
            target_sources(${name} PRIVATE ${source})
        endforeach()
        target_include_directories(${name} PRIVATE $<TARGET_PROPERTY:${target},INCLUDE_DIRECTORIES>)
        target_compile_definitions(${name} PRIVATE $<TARGET_PROPERTY:${target},COMPILE_DEFINITIONS>)
        get_target_property(links ${target} LINK_LIBRARIES)
        target_link_libraries(${name} PRIVATE ${links})
    endforeach()
    set_target_properties(${name} PROPERTIES
        UNITY_BUILD ON
        UNITY_BUILD_BATCH_SIZE 0
        UNITY_BUILD_UNIQUE_ID main # every program has its own main(): so each gets another name
        CXX_CLANG_TIDY ${HAPNET_CLANG_TIDY}
        CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND};-E;true") # in the compiler's place
    add_dependencies(${name} hapnet_commit)
    add_dependencies(tidy ${name})
endfunction()

add_custom_target(tidy ALL)
get_property(libraries GLOBAL PROPERTY HAPNET_LIBRARIES)
get_property(programs GLOBAL PROPERTY HAPNET_PROGRAM_TARGETS)
# Apart from the rest are toml++, which brings names of the standard library that ours would be
# mistaken for, and hapnet-ctl, whose names are those of hapnet-emulator.
set(shells hapnet_emulator_shell hapnet_lab_shell hapnet_peer_shell) # all but the programs' main()
list(REMOVE_ITEM libraries hapnet_base hapnet_base_texts hapnet_emulator_control ${shells})
list(REMOVE_ITEM programs hapnet-ctl)
# The longest first, and two of about equal length, for two cores.
set(emulator_and_lab ${libraries})
list(FILTER emulator_and_lab INCLUDE REGEX "^hapnet_(emulator|lab)_")
list(REMOVE_ITEM libraries ${emulator_and_lab})
hapnet_tidy_unit(tidy_libraries ${libraries})
hapnet_tidy_unit(tidy_emulator_and_lab ${emulator_and_lab})
hapnet_tidy_unit(tidy_programs ${shells} ${programs})
hapnet_tidy_unit(tidy_control hapnet_emulator_control hapnet-ctl)
hapnet_tidy_unit(tidy_base hapnet_base hapnet_base_texts)

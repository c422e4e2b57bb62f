# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# What every target of the project is compiled with.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

# What was compiled before is taken from the cache of ccache, where that is installed. It must know
# that a precompiled header is an input like any other, and that the name of the clone's folder is
# not.
find_program(HAPNET_CCACHE ccache)
if(HAPNET_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
        CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
        ${HAPNET_CCACHE})
endif()

option(HAPNET_WARNINGS_AS_ERRORS "Treat warnings as errors" OFF)
set(HAPNET_SANITIZE "" CACHE STRING "Sanitizers, e.g. address,undefined")
set_property(CACHE HAPNET_SANITIZE PROPERTY STRINGS "" "address,undefined" "thread")

# Vectors and quaternions, which an emulator has none of.
if(NOT HAPNET_ONLY)
    set(HAPNET_GLM glm::glm)
    set(HAPNET_GLM_HEADERS <glm/gtc/quaternion.hpp> <glm/glm.hpp>)
endif()

add_library(hapnet_options INTERFACE)
target_include_directories(hapnet_options INTERFACE ${PROJECT_SOURCE_DIR})
target_compile_options(hapnet_options INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
    -Wnon-virtual-dtor
    # One result for one seed, whatever the compiler: no fused multiply-add behind our back.
    -ffp-contract=off)
target_compile_definitions(hapnet_options INTERFACE GLM_FORCE_EXPLICIT_CTOR)
# GCC clears a struct of 33 bytes or more by `rep stos`, which takes longer to begin than to do: a
# peer's tick is a tenth slower so (measured 2026, GCC 12, AMD EPYC).
include(CheckCXXCompilerFlag)
set(HAPNET_CLEARING -mmemset-strategy=unrolled_loop:512:noalign,libcall:-1:noalign)
check_cxx_compiler_flag("${HAPNET_CLEARING}" HAPNET_HAS_CLEARING)
if(HAPNET_HAS_CLEARING)
    target_compile_options(hapnet_options INTERFACE "${HAPNET_CLEARING}")
endif()
# GCC looks for memory to use again from 128 MB on, which a unit of several files reaches at once. A
# tenth of its time or more is spent so. From 1 GB on, the largest unit takes 2.3 GB.
target_compile_options(hapnet_options INTERFACE
    "$<$<CXX_COMPILER_ID:GNU>:SHELL:--param ggc-min-heapsize=1000000>")
if(HAPNET_CCACHE)
    # With these, ccache can tell which precompiled header was read, and whether it is the same.
    target_compile_options(hapnet_options INTERFACE
        $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>
        "$<$<COMPILE_LANG_AND_ID:CXX,Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()
# A program with sanitizers is some 30 MB: 0.3 s to link, and not 1.4 s.
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
    include(CheckLinkerFlag)
    check_linker_flag(CXX -fuse-ld=lld HAPNET_HAS_LLD)
    if(HAPNET_HAS_LLD)
        target_link_options(hapnet_options INTERFACE -fuse-ld=lld)
    endif()
endif()
if(HAPNET_WARNINGS_AS_ERRORS)
    target_compile_options(hapnet_options INTERFACE -Werror)
endif()
if(HAPNET_SANITIZE)
    target_compile_definitions(hapnet_options INTERFACE HAPNET_SANITIZED)
    target_compile_options(hapnet_options INTERFACE
        -fsanitize=${HAPNET_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(hapnet_options INTERFACE -fsanitize=${HAPNET_SANITIZE})
endif()

# hapnet_cold(TARGET): what it does takes no time when it runs, so optimising it takes little, too:
# a third less to compile (GCC 12: 25 s and not 36 s for the pages of a report).
set(HAPNET_COLD "" CACHE STRING "How code whose run time does not matter is optimised instead")
function(hapnet_cold target)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1> ${HAPNET_COLD})
    set_target_properties(${target} PROPERTIES HAPNET_IS_COLD ON)
endfunction()

# What most files include is read once instead of once a file: a quarter of an unoptimised build.
# Off by default, so that a file that forgets an include is found.
option(HAPNET_PRECOMPILED "Precompile the headers that most files include" OFF)
set(HAPNET_COMMON_HEADERS <algorithm> <array> <chrono> <cmath> <functional> <map> <memory>
    <optional> <span> <string> <string_view> <tuple> <utility> <variant> <vector>
    ${HAPNET_GLM_HEADERS} <spdlog/fmt/fmt.h> <tl/expected.hpp>)
function(hapnet_precompiled_headers name)
    if(NOT TARGET ${name})
        set(source ${PROJECT_BINARY_DIR}/precompiled/${name}.cpp)
        file(CONFIGURE OUTPUT ${source} CONTENT "")
        add_library(${name} OBJECT ${source})
        target_link_libraries(${name} PRIVATE hapnet_options ${HAPNET_GLM} spdlog::spdlog
            tl::expected)
        target_precompile_headers(${name} PRIVATE ${HAPNET_COMMON_HEADERS} ${ARGN})
    endif()
endfunction()

# hapnet_also_shared(TARGET): a shared library has its code, too. Its names are nobody else's, so
# that calls within it stay as direct as in a program.
function(hapnet_also_shared target)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON
        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# hapnet_precompile(TARGET): said when all else is said of it. Clang reads what it has precompiled
# only at the same level of optimisation: where cold code has one of its own, it also has headers of
# its own. JSON is among those. GCC would spend 0.6 s on it in every unit, used or not.
function(hapnet_precompile name)
    if(NOT HAPNET_PRECOMPILED)
        return()
    endif()
    get_target_property(is_cold ${name} HAPNET_IS_COLD)
    get_target_property(is_shared ${name} POSITION_INDEPENDENT_CODE)
    if(is_shared)
        hapnet_precompiled_headers(hapnet_precompiled_shared)
        hapnet_also_shared(hapnet_precompiled_shared)
        target_precompile_headers(${name} REUSE_FROM hapnet_precompiled_shared)
    elseif(is_cold AND HAPNET_COLD)
        hapnet_precompiled_headers(hapnet_precompiled_cold <nlohmann/json.hpp>)
        hapnet_cold(hapnet_precompiled_cold)
        target_precompile_headers(${name} REUSE_FROM hapnet_precompiled_cold)
    else()
        hapnet_precompiled_headers(hapnet_precompiled)
        target_precompile_headers(${name} REUSE_FROM hapnet_precompiled)
    endif()
endfunction()

# hapnet_sources(OUT FOLDER ...): the sources in these folders and below them. A new file is found
# when the build begins.
function(hapnet_sources out)
    set(found)
    foreach(folder IN LISTS ARGN)
        file(GLOB_RECURSE sources CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
            ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
        list(APPEND found ${sources})
    endforeach()
    set(${out} ${found} PARENT_SCOPE)
endfunction()

# hapnet_read_by_folder(TARGET): where several files are read as one, those of one folder are.
function(hapnet_read_by_folder target)
    get_target_property(sources ${target} SOURCES)
    foreach(source IN LISTS sources)
        cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
        cmake_path(GET source PARENT_PATH folder)
        cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
        string(MAKE_C_IDENTIFIER ${folder} group)
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endforeach()
    set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# Sanitizers keep to programs.
set(HAPNET_HAS_SHARED ON)
if(HAPNET_SANITIZE)
    set(HAPNET_HAS_SHARED OFF)
endif()

# hapnet_library(NAME [COLD] [SMALL] [ALSO_SHARED] [FOLDERS ... [WITHOUT ...]] [SOURCES ...]
# [DEPENDS ...]): a room of the map, built where it is needed. SMALL: where several files are read
# as one, all is. ALSO_SHARED: see hapnet_also_shared(). WITHOUT: these files of the folders are in
# another library.
function(hapnet_library name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "COLD;SMALL;ALSO_SHARED" ""
        "FOLDERS;WITHOUT;SOURCES;DEPENDS")
    hapnet_sources(sources ${arg_FOLDERS})
    list(REMOVE_ITEM sources ${arg_WITHOUT})
    add_library(${name} STATIC EXCLUDE_FROM_ALL ${sources} ${arg_SOURCES})
    target_link_libraries(${name} PUBLIC $<BUILD_INTERFACE:hapnet_options>
        $<INSTALL_INTERFACE:hapnet_requirements> ${arg_DEPENDS})
    if(arg_SMALL)
        set_target_properties(${name} PROPERTIES UNITY_BUILD_BATCH_SIZE 0)
    else()
        hapnet_read_by_folder(${name})
    endif()
    if(arg_COLD)
        hapnet_cold(${name})
    endif()
    if(arg_ALSO_SHARED AND HAPNET_HAS_SHARED)
        hapnet_also_shared(${name})
    endif()
    hapnet_precompile(${name})
    set_property(GLOBAL APPEND PROPERTY HAPNET_LIBRARIES ${name})
endfunction()

# hapnet_component(OUT THING): the package that a program, or a kind of its files, belongs to.
function(hapnet_component out thing)
    set(of_emulator hapnet-emulator hapnet-ctl profiles)
    set(${out} hapnet PARENT_SCOPE)
    if(thing IN_LIST of_emulator)
        set(${out} hapnet-emulator PARENT_SCOPE)
    elseif(thing STREQUAL "hapnet-web")
        set(${out} hapnet-web PARENT_SCOPE)
    endif()
endfunction()

option(HAPNET_PROGRAMS "Build the programs, which the tests end to end need" ON)

# hapnet_program(NAME [COLD] [FOLDERS ...] [SOURCES ...] DEPENDS ...): one binary that is installed.
# Where several files are read as one, all of it is.
function(hapnet_program name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "COLD" "" "FOLDERS;SOURCES;DEPENDS")
    hapnet_sources(sources ${arg_FOLDERS})
    add_executable(${name} ${sources} ${arg_SOURCES})
    target_link_libraries(${name} PRIVATE hapnet_options ${arg_DEPENDS})
    set_target_properties(${name} PROPERTIES UNITY_BUILD_BATCH_SIZE 0)
    if(arg_COLD)
        hapnet_cold(${name})
    endif()
    hapnet_precompile(${name})
    set_property(GLOBAL APPEND PROPERTY HAPNET_PROGRAM_TARGETS ${name})
    if(HAPNET_PROGRAMS)
        hapnet_component(component ${name})
        install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
                COMPONENT ${component})
    else()
        set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
endfunction()

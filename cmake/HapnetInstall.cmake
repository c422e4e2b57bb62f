# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The libraries for other programs: archives, headers, what find_package(hapnet) reads, and files of
# pkg-config. All of it is of the component hapnet-dev; docs/use/libraries.md is for its users.
include(CMakePackageConfigHelpers)

# What the headers need of those who include them. In this build it is part of hapnet_options.
add_library(hapnet_requirements INTERFACE)
target_compile_features(hapnet_requirements INTERFACE cxx_std_20)
target_compile_definitions(hapnet_requirements INTERFACE GLM_FORCE_EXPLICIT_CTOR)
target_compile_options(hapnet_requirements INTERFACE -ffp-contract=off) # equal seeds, equal bits
target_include_directories(hapnet_requirements INTERFACE
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/hapnet>)

# What the programs share: messages, records, keys, sockets and the clock.
add_library(hapnet_proto INTERFACE)
target_link_libraries(hapnet_proto INTERFACE
    hapnet_record hapnet_wire hapnet_secure hapnet_net hapnet_disk hapnet_base)

set(hapnet_archives hapnet_base hapnet_base_texts hapnet_disk hapnet_wire hapnet_record
    hapnet_secure hapnet_net hapnet_scene hapnet_emulator_core hapnet_emulator_profiles
    hapnet_device hapnet_peer_core hapnet_peer_line hapnet_lab_core)
foreach(library IN LISTS hapnet_archives ITEMS hapnet_proto hapnet_requirements)
    string(REGEX REPLACE "^hapnet_" "" name ${library})
    set_target_properties(${library} PROPERTIES EXPORT_NAME ${name})
endforeach()
set_target_properties(${hapnet_archives} PROPERTIES EXCLUDE_FROM_ALL OFF)
set_target_properties(hapnet_lab_core PROPERTIES EXPORT_NAME lab)
add_custom_target(hapnet_libraries DEPENDS ${hapnet_archives})
if(TARGET hapnet_link)
    add_dependencies(hapnet_libraries hapnet_link)
endif()

set(hapnet_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hapnet)
install(TARGETS ${hapnet_archives} hapnet_proto hapnet_requirements EXPORT hapnetTargets
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT hapnet-dev)
install(EXPORT hapnetTargets NAMESPACE hapnet:: DESTINATION ${hapnet_cmake_dir}
    COMPONENT hapnet-dev)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/hapnetConfig.cmake.in
    ${PROJECT_BINARY_DIR}/hapnetConfig.cmake INSTALL_DESTINATION ${hapnet_cmake_dir}
    NO_SET_AND_CHECK_MACRO)
# Before 1.0.0 every second number may break what was built on the one before.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hapnetConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hapnetConfig.cmake
    ${PROJECT_BINARY_DIR}/hapnetConfigVersion.cmake
    DESTINATION ${hapnet_cmake_dir} COMPONENT hapnet-dev)

# The headers keep their folders, below include/hapnet.
foreach(folder proto/base proto/disk proto/wire proto/record proto/net scene emulator/core
        device/governor device/omni device/page device/replay device/simulated peer/core peer/line
        lab/metrics lab/virtual_time)
    file(GLOB_RECURSE headers RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
        ${PROJECT_SOURCE_DIR}/${folder}/*.hpp)
    list(APPEND hapnet_headers ${headers})
endforeach()
file(GLOB headers RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
    ${PROJECT_SOURCE_DIR}/device/*.hpp ${PROJECT_SOURCE_DIR}/proto/secure/*.hpp)
list(APPEND hapnet_headers ${headers} device/falcon/kinematics.hpp device/falcon/packet.hpp
    peer/core/abi/algorithm.h)
foreach(header IN LISTS hapnet_headers)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${PROJECT_SOURCE_DIR}/${header}
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hapnet/${folder} COMPONENT hapnet-dev)
endforeach()
# What is written in C, for algorithms that are no part of the programs, needs no other.
install(FILES ${PROJECT_SOURCE_DIR}/peer/core/abi/algorithm.h
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hapnet COMPONENT hapnet-dev)

# The emulated path for programs in C: the library is a package of its own, which they need to run.
if(TARGET hapnet_link)
    install(TARGETS hapnet_link LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        COMPONENT libhapnet-link0 NAMELINK_COMPONENT hapnet-dev)
endif()
install(FILES ${PROJECT_SOURCE_DIR}/emulator/abi/hapnet_link.h
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT hapnet-dev)

# hapnet_pkg_config(NAME ABOUT [REQUIRES ...] [PRIVATE ...] ARCHIVES ...): NAME.pc. Archives that
# need each other stand in one word, so that nobody takes one out. Everything is found from where
# the file lies: an installed tree may be moved.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_FULL_LIBDIR BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}
    OUTPUT_VARIABLE libdir)
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX
    BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig OUTPUT_VARIABLE hapnet_up)
function(hapnet_pkg_config name about)
    cmake_parse_arguments(PARSE_ARGV 2 arg "" "" "REQUIRES;ARCHIVES")
    list(TRANSFORM arg_ARCHIVES PREPEND "-lhapnet_")
    list(JOIN arg_ARCHIVES "," archives)
    list(JOIN arg_REQUIRES ", " requires)
    set(define -DGLM_FORCE_EXPLICIT_CTOR)
    set(file ${PROJECT_BINARY_DIR}/${name}.pc)
    file(CONFIGURE OUTPUT ${file} @ONLY CONTENT [[
prefix=${pcfiledir}/@hapnet_up@
libdir=${prefix}/@libdir@
includedir=${prefix}/@CMAKE_INSTALL_INCLUDEDIR@

Name: @name@
Description: @about@
Version: @PROJECT_VERSION@
Requires: @requires@
Libs: -L${libdir} -Wl,--start-group,@archives@,--end-group
Cflags: -I${includedir}/hapnet -I${includedir} -std=c++20 -ffp-contract=off @define@
]])
    install(FILES ${file} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT hapnet-dev)
endfunction()
hapnet_pkg_config(hapnet-base "Hapnet: units, time, chance and text" REQUIRES spdlog
    ARCHIVES base base_texts)
hapnet_pkg_config(hapnet-proto "Hapnet: messages, records, keys, sockets"
    REQUIRES hapnet-base libsodium ARCHIVES record wire secure net disk)
hapnet_pkg_config(hapnet-scene "Hapnet: the physics of the shared scene" REQUIRES hapnet-base
    ARCHIVES scene)
hapnet_pkg_config(hapnet-emulator-core "Hapnet: an emulated network path in virtual time"
    REQUIRES hapnet-base ARCHIVES emulator_core emulator_profiles)
hapnet_pkg_config(hapnet-lab "Hapnet: peers, and whole sessions in virtual time"
    REQUIRES hapnet-emulator-core hapnet-scene hapnet-proto
    ARCHIVES lab_core peer_line peer_core device)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/hapnet-link.pc @ONLY CONTENT [[
prefix=${pcfiledir}/@hapnet_up@
libdir=${prefix}/@libdir@

Name: hapnet-link
Description: Hapnet: an emulated network path, for C
Version: @PROJECT_VERSION@
Libs: -L${libdir} -lhapnet-link
Cflags: -I${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
]])
install(FILES ${PROJECT_BINARY_DIR}/hapnet-link.pc
    DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT hapnet-dev)

# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# -DHAPNET_STATIC=ON: programs that need no shared library but those of the C library and libudev,
# to run where Debian's packages are not. Nothing is compiled in another way; it is linked in
# another. Packages are made without it: there the system's libraries get the system's updates.
add_link_options(-static-libstdc++ -static-libgcc
    -Wl,--undefined=arc4random) # ours, of packaging/static, before that of the C library
set(CMAKE_SKIP_RPATH ON)

function(hapnet_link_archive target archive)
    find_library(HAPNET_ARCHIVE_${archive} NAMES ${archive} REQUIRED)
    set_target_properties(${target} PROPERTIES
        INTERFACE_LINK_LIBRARIES "${HAPNET_ARCHIVE_${archive}};${ARGN}")
endfunction()
if(TARGET PkgConfig::LIBUSB)
    hapnet_link_archive(PkgConfig::LIBUSB libusb-1.0.a udev Threads::Threads)
    hapnet_link_archive(PkgConfig::HIDAPI libhidapi-hidraw.a udev)
    hapnet_link_archive(PkgConfig::SODIUM libsodium.a)
endif()

add_subdirectory(packaging/static)
foreach(library fmt::fmt spdlog::spdlog)
    set_target_properties(${library} PROPERTIES
        IMPORTED_LOCATION_NONE ${PROJECT_BINARY_DIR}/libhapnet_fmt.a)
    add_dependencies(${library} hapnet_fmt)
endforeach()

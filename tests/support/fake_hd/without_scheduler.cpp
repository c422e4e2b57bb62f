// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A library that has one function of libHD and lacks the others.
#include "device/hdapi/library.hpp"

extern "C" hapnet::device::hdapi::Handle hdInitDevice(const char* /*name*/)
{
    return hapnet::device::hdapi::no_device;
}

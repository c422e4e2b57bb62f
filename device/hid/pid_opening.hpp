// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/fault.hpp"
#include "device/hid/pid_layout.hpp"
#include "device/hid/wire.hpp"

#include <cstdint>
#include <vector>

namespace hapnet::device::hid {

/// A device in which our effects are allocated, without force and not playing, and whose actuators
/// are disabled.
struct Prepared {
    std::vector<std::uint32_t> blocks{}; // one effect for each axis: x, then y
};

/// Resets the device, requests a constant force per axis, and sets these effects up. If this fails,
/// none of our effects stays in the device.
[[nodiscard]] Opened<Prepared> prepare(Wire& wire, const ForceLayout& layout, std::size_t axes);

} // namespace hapnet::device::hid

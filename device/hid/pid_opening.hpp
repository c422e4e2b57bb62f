// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/fault.hpp"
#include "device/hid/pid_layout.hpp"
#include "device/hid/wire.hpp"

#include <cstdint>
#include <vector>

namespace hapnet::device::hid {

/// A device that holds our effects, all without force and not playing, its actuators disabled.
struct Prepared {
    std::vector<std::uint32_t> blocks{}; // one effect for each axis: x, then y
};

/// Resets the device, asks it for a constant force per axis, and sets these up. Where it fails, no
/// effect of ours is left behind.
[[nodiscard]] Opened<Prepared> prepare(Wire& wire, const ForceLayout& layout, std::size_t axes);

} // namespace hapnet::device::hid

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

namespace hapnet::device::hid {

/// Options for values that no descriptor contains.
struct Options {
    /// The measured force at the grip, in newtons, when the device pushes at full scale; negative
    /// if it pushes in the opposite direction. Without this value there is no force.
    std::optional<double> force_full_n{};
    /// The largest force on the hand, N, whatever the device's full scale is: a wheel base can
    /// break a wrist. The default is the peak of a PHANToM Omni.
    double force_cap_n = 3.3;
    /// Half of the distance between the stops of an axis, at the grip, in metres. The default is
    /// half the width of a PHANToM Omni's workspace, so that the paper's scene fits.
    double reach_m = 0.08;
};

} // namespace hapnet::device::hid

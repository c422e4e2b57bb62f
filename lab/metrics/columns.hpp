// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/trace.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hapnet::lab::metrics {

/// The numbers of one side that metrics read, one contiguous column for each. A sample is three
/// cache lines long, and a metric needs only two numbers of it. SI units; x components.
struct Columns {
    std::vector<double> body_x;
    std::vector<double> body_y;
    std::vector<double> hip_x;
    std::vector<double> hand_force;     // force of the device on the hand
    std::vector<double> push;           // length of the contact force
    std::vector<double> work;           // work of the hand on the device from this tick to the next
    std::vector<std::uint8_t> touching; // 1: this side's hand touches or holds
    std::vector<std::uint8_t> follows;  // 1: only hands of other sides touch
};

[[nodiscard]] Columns columns_of(std::span<const virtual_time::Sample> side);

} // namespace hapnet::lab::metrics

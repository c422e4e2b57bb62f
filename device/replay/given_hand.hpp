// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/replay/hand_trace.hpp"
#include "device/velocity_filter.hpp"

#include <cstdint>

namespace hapnet::device {

/// A hand whose places are given from outside, whatever force it feels: recorded or of a page. Both
/// report the same sample for the same place, so that a recording repeats a session to the bit.
class GivenHand {
public:
    static constexpr double velocity_cutoff_hertz = 30.0;

    /// Capabilities of such a hand: it takes any force of an Omni, and gives way to none.
    [[nodiscard]] static Capabilities capabilities();

    /// The report on the hand at `moment`. Its velocity is that of a device: the differences of
    /// the places, low-passed at 30 Hz.
    [[nodiscard]] Sample sample(const HandMoment& moment, base::TimePoint now);

private:
    std::uint64_t reads_ = 0;
    VelocityFilter velocity_{velocity_cutoff_hertz};
};

} // namespace hapnet::device

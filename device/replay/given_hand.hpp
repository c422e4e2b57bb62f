// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/replay/hand_trace.hpp"
#include "device/velocity_filter.hpp"

#include <cstdint>

namespace hapnet::device {

/// A hand whose positions are given from outside, by a recording or a page, and do not depend on
/// the force. Both report the same sample for the same position, so that a recording repeats a
/// session to the bit.
class GivenHand {
public:
    static constexpr double velocity_cutoff_hertz = 30.0;

    /// Returns the capabilities of such a hand: it accepts any force of an Omni, and does not yield
    /// to it.
    [[nodiscard]] static Capabilities capabilities();

    /// Returns the sample for the hand at `moment`. Its velocity is like that of a device: the
    /// differences of the positions, low-passed at 30 Hz.
    [[nodiscard]] Sample sample(const HandMoment& moment, base::TimePoint now);

private:
    std::uint64_t reads_ = 0;
    VelocityFilter velocity_{velocity_cutoff_hertz};
};

} // namespace hapnet::device

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/governor/limits.hpp"
#include "device/governor/trip.hpp"

namespace hapnet::device {

/// Whether a force may follow from what a device says.
enum class Finding : std::uint8_t {
    usable,
    unheard,      // no report from it yet
    silent,       // nothing new for stall_max: what it said last may be long untrue
    docked,       // the stylus is in its holder
    uncalibrated, // positions mean nothing
    too_fast,     // while it gives no force: wait until it is slower
    tripped,      // a fault, to be latched
};

/// Looks at one sample after the other.
class SampleCheck {
public:
    struct Result {
        Finding finding = Finding::usable;
        Latched fault{}; // where it is tripped
    };

    /// `passed` since the last sample, and zero after a stall of the loop: nobody asked the device.
    /// `pushing`: a force may be felt now.
    [[nodiscard]] Result look(const GovernorLimits& limits, const Sample& sample,
                              base::Duration passed, bool pushing);

private:
    [[nodiscard]] Trip too_fast(const GovernorLimits& limits, const Sample& sample,
                                base::Duration since_last) const;

    bool heard_ = false;
    bool placed_ = false; // place_ means something
    std::uint64_t sequence_ = 0;
    base::Duration silence_{}; // since the last new sample
    base::Position place_;     // of that
};

} // namespace hapnet::device

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hapnet::device {

/// A fault of a simulated device.
struct InjectedFault {
    enum class Kind : std::uint8_t {
        dropped_reports,     // every other report is lost
        stall,               // the device is silent
        unplug,              // the device has gone for good
        encoder_jump,        // the waist's encoder is off by 500 counts
        communication_error, // the device's reports are invalid
        not_a_number,        // positions are NaN, which the interface does not permit
    };
    Kind kind;
    base::Duration after; // time from the first read to the fault
    base::Duration lasts;
};

/// Faults of a simulated device, and their times, for tests and for trying out the reactions.
struct InjectedFaults {
    std::vector<InjectedFault> schedule;

    [[nodiscard]] bool has(InjectedFault::Kind kind, base::Duration since_start) const
    {
        return std::any_of(
            schedule.begin(), schedule.end(), [&](const InjectedFault& injected_fault) {
                return injected_fault.kind == kind && since_start >= injected_fault.after &&
                       since_start - injected_fault.after < injected_fault.lasts;
            });
    }
};

} // namespace hapnet::device

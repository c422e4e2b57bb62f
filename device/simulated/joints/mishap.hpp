// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hapnet::device {

/// Something that goes wrong with a simulated device.
struct Mishap {
    enum class Kind : std::uint8_t {
        dropped_words,       // every other word of it is lost
        stall,               // it is silent
        unplug,              // it has gone, for good
        encoder_jump,        // the waist's encoder is off by 500 counts
        communication_error, // its words make no sense
        not_a_number,        // it breaks the promise of its interface: its positions are NaN
    };
    Kind kind;
    base::Duration after; // the first read
    base::Duration lasts;
};

/// What goes wrong with a simulated device, and when: for tests, and for who wants to see what
/// happens then.
struct Mishaps {
    std::vector<Mishap> schedule;

    [[nodiscard]] bool has(Mishap::Kind kind, base::Duration since_start) const
    {
        return std::any_of(schedule.begin(), schedule.end(), [&](const Mishap& mishap) {
            return mishap.kind == kind && since_start >= mishap.after &&
                   since_start - mishap.after < mishap.lasts;
        });
    }
};

} // namespace hapnet::device

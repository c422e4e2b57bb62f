// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/profile/profile.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// The conditions over time, according to a profile. A ramp is a straight line from the value at
/// its beginning. A later change of the same setting continues from the value that the ramp has at
/// that time. Changes at equal times apply in their order.
class Timeline {
public:
    /// The time between two changes of the conditions while a ramp lasts.
    static constexpr base::Duration ramp_step = std::chrono::milliseconds{1};

    /// The greatest number of ramps that may follow each other without a pause, or overlap.
    static constexpr std::size_t ramps_max = 64;

    /// A change of a profile that cannot be made.
    struct BadChange {
        std::size_t index = 0; // its place in the timeline, from 0
        std::string message;
    };

    /// Refuses the first change that cannot be made. Ensures that the changes ascend in time.
    [[nodiscard]] static tl::expected<void, BadChange> validate(const Profile& profile);

    /// Ensures that the profile is valid.
    explicit Timeline(const Profile& profile);

    /// Returns the conditions at a time since the run began, which is not negative.
    [[nodiscard]] Path at(base::Duration since_start) const;

    /// Returns the first time after `after` at which the conditions may change; nullopt: they never
    /// change again.
    [[nodiscard]] std::optional<base::Duration> next_change(base::Duration after) const;

private:
    struct Step {
        Change change;
        Path before;           // conditions at its time, just before it
        std::size_t first = 0; // the earliest step whose ramp may still be in progress then
    };

    explicit Timeline(const Path& start) : start_{start} {}

    /// Adds the next change, or returns why it cannot be made.
    [[nodiscard]] base::Result<void> add(const Change& change);
    [[nodiscard]] Path at(base::Duration since_start, std::size_t steps) const;
    /// Returns the number of steps with a time <= since_start.
    [[nodiscard]] std::size_t steps_until(base::Duration since_start) const;

    Path start_;
    std::vector<Step> steps_;
};

} // namespace hapnet::emulator

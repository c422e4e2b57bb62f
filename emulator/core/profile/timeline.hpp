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

/// What holds when, by a profile. A ramp goes in a straight line from what held at its beginning;
/// a later change of the same setting takes over from wherever the ramp is. Changes at equal times
/// hold in their order.
class Timeline {
public:
    /// While a ramp lasts, the conditions change so often.
    static constexpr base::Duration ramp_step = std::chrono::milliseconds{1};

    /// The most ramps that may follow each other without a pause, or go on at once.
    static constexpr std::size_t ramps_max = 64;

    /// A change of a profile that cannot be made.
    struct BadChange {
        std::size_t index = 0; // in the timeline
        std::string message;
    };

    /// Whether all changes can be made, or the first that cannot. Ensures that they ascend in time.
    [[nodiscard]] static tl::expected<void, BadChange> validate(const Profile& profile);

    /// Ensures that the profile is valid.
    explicit Timeline(const Profile& profile);

    /// What holds at that time since the run began, which is not negative.
    [[nodiscard]] Path at(base::Duration since_start) const;

    /// The first time after `after` at which something else may hold; nullopt: never again.
    [[nodiscard]] std::optional<base::Duration> next_change(base::Duration after) const;

private:
    struct Step {
        Change change;
        Path before;           // what held at its time, just before it
        std::size_t first = 0; // the earliest step whose ramp may still go on then
    };

    explicit Timeline(const Path& start) : start_{start} {}

    /// Adds the next change, or says why it cannot be made.
    [[nodiscard]] base::Result<void> add(const Change& change);
    [[nodiscard]] Path at(base::Duration since_start, std::size_t steps) const;
    /// How many steps have a time <= since_start.
    [[nodiscard]] std::size_t steps_until(base::Duration since_start) const;

    Path start_;
    std::vector<Step> steps_;
};

} // namespace hapnet::emulator

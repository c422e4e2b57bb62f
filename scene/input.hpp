// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

#include <array>
#include <cstdint>

namespace hapnet::scene {

/// A body's index in its description.
using BodyId = std::uint32_t;

/// Where a hand is at the start of a tick. During the tick it moves on at its velocity (first-order
/// hold), so that a steady push has no lag of one tick.
struct HandInput {
    base::Position position{};
    base::Velocity velocity{};
    bool present = true; // false: it touches nothing
    bool gripping = false;
};

/// Why an input was not taken; the world is as it was.
enum class Refusal : std::uint8_t { not_finite, out_of_range, no_such_body, no_such_hand };
inline constexpr std::size_t refusals = 4;

/// How many inputs were refused, by cause.
using RefusalCounts = std::array<std::uint64_t, refusals>;

/// What a hand did and felt in the last tick.
struct HandTouch {
    bool touching = false; // pushed or held a movable body
    bool holding = false;
    BodyId body = 0;                // the movable one that it touched
    base::Force on_body{};          // on the movable body: the mean over the tick
    base::Force on_hand{};          // by everything it touched: the mean over the tick
    double depth_m = 0.0;           // at the start of the tick, of the deepest contact
    base::Force on_hand_at_start{}; // the spring and damper at the start of the tick
};

/// A rigid body's place and motion.
struct BodyState {
    base::Position position{};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    base::Velocity velocity{};
    glm::dvec3 angular_velocity{0.0}; // rad/s, in the world's frame
};

} // namespace hapnet::scene

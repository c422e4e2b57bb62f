// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/state.hpp"

#include <algorithm>
#include <cstdint>

namespace hapnet::scene {

// The force of a hand on the bodies that it touches. It is the same for every stepper. While they
// overlap, a hand pushes along the normal through a spring and a damper with clamp(stiffness depth
// + damping closing speed, 0, force_max). A hand that grips also pulls, in all directions.

enum class SpringPhase : std::uint8_t {
    apart,    // no overlap
    slack,    // they overlap, but the spring would have to pull: no force either
    pressing, // the force is between 0 and the greatest force
    limited,  // the force is the greatest force
};

/// Returns the push of the spring and damper at one moment, N.
[[nodiscard]] inline double force_at(const HandDescription& hands, double depth, double closing)
{
    if (depth <= 0.0) return 0.0;
    return std::clamp(hands.stiffness_n_per_m * depth + hands.damping_ns_per_m * closing, 0.0,
                      hands.force_max_n);
}

/// Returns the impulse of that push over `time` on something that stands still, N s. It is exact,
/// since the depth is linear in time.
[[nodiscard]] double impulse_at_constant_velocity(const HandDescription& hands, double depth,
                                                  double closing, double time);

/// Returns the distance from a hand's centre within which the hand can grip a surface.
[[nodiscard]] inline double grip_distance(const HandDescription& hands)
{
    return hands.radius_m + hands.grip_reach_m;
}

/// Returns the force of a grip at one moment on the body that it holds, without the limit of force.
/// `stretch` goes from the held point to the hand; `velocity` is the hand's, relative to that
/// point.
[[nodiscard]] inline base::Force grip_force(const HandDescription& hands, const glm::dvec3& stretch,
                                            const glm::dvec3& velocity)
{
    return {hands.stiffness_n_per_m * stretch + hands.damping_ns_per_m * velocity};
}

/// Adds a push to the forces that the hand feels at the start of the tick.
inline void note_push(HandTouch& touch, double depth, const glm::dvec3& force_on_hand)
{
    touch.depth_m = std::max(touch.depth_m, depth);
    touch.on_hand_at_start.value += force_on_hand;
}

/// Adds a grip to them; `distance` is from the hand's centre to the surface.
inline void note_grip(HandTouch& touch, const HandDescription& hands, double distance,
                      base::Force force_on_body)
{
    touch.holding = true;
    touch.depth_m = std::max(touch.depth_m, std::max(hands.radius_m - distance, 0.0));
    touch.on_hand_at_start += -force_on_body;
}

} // namespace hapnet::scene

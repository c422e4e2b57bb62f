// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/touch.hpp"

#include <glm/geometric.hpp>

namespace hapnet::peer {

namespace {

/// The force of a box on a hand that overlaps it.
base::Force push(const Scene& scene, const std::optional<Overlap>& overlap, base::Velocity relative)
{
    if (!overlap) return {};
    const double closing_speed = -glm::dot(relative.value, overlap->normal);
    return {contact_force(scene, overlap->depth, closing_speed) * overlap->normal};
}

} // namespace

Touched Touch::feel(const Hand& hand, const Box& cube, base::Velocity cube_velocity)
{
    const auto overlap = movable_.find(cube, hand.hip, scene_.hip_radius_m);
    const auto wall = static_.find(scene_.static_cube, hand.hip, scene_.hip_radius_m);

    if (!hand.gripping) {
        held_at_.reset();
    } else if (!held_at_ && distance(cube, hand.hip) <= scene_.hip_radius_m + scene_.grip_reach_m) {
        held_at_ = hand.hip - cube.centre;
    }

    Touched touched;
    touched.holding = held_at_.has_value();
    touched.on_cube = touched.holding ? pull(hand, cube, cube_velocity)
                                      : -push(scene_, overlap, hand.velocity - cube_velocity);
    touched.touching = touched.holding || base::norm(touched.on_cube) > 0.0;
    touched.on_hand = push(scene_, wall, hand.velocity) - touched.on_cube;
    return touched;
}

base::Force Touch::pull(const Hand& hand, const Box& cube, base::Velocity cube_velocity) const
{
    const base::Displacement stretch = hand.hip - (cube.centre + *held_at_);
    const base::Velocity relative = hand.velocity - cube_velocity;
    const base::Force force{scene_.stiffness_n_per_m * stretch.value +
                            scene_.damping_ns_per_m * relative.value};
    return base::limited(force, scene_.force_max_n);
}

} // namespace hapnet::peer

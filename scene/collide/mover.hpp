// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/steady_box.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace hapnet::scene {

/// The reach of a box from its centre over all its turns, while it turns steadily. Its corners move
/// in circles about the axis of its spin. For a round body, the reach of its core.
struct Whirl {
    // The turn, in radians, from which it pays to compute the reach of a box over all its turns.
    static constexpr double far_turn = 0.5;

    glm::dvec3 axis{0.0};
    std::array<double, 4> along{}; // m, along the axis: one for each pair of opposite corners
    std::array<double, 4> across{};
    double widest = 0.0; // m: the largest of `across`, or the radius
    bool is_known = false;

    /// Finds the reach of a box that turns far enough within `time`. Otherwise the reach is its
    /// radius.
    Whirl(const SteadyBox& box, double time)
    {
        const double square = glm::dot(box.spin, box.spin);
        const double radius = box.core_radius();
        if (!(time * time * square > far_turn * far_turn)) {
            widest = radius;
            return;
        }
        is_known = true;
        axis = box.spin / std::sqrt(square);
        if (box.is_part) { // the part is not around the axis, so only its radius is known
            along.fill(radius);
            across.fill(radius);
            widest = radius;
            return;
        }
        const glm::dvec3 part = box.core_half() * (axis * axes_of(box.orientation));
        along = {part.x + part.y + part.z, part.x + part.y - part.z, part.x - part.y + part.z,
                 part.y + part.z - part.x};
        for (std::size_t i = 0; i < along.size(); ++i) {
            along[i] = std::abs(along[i]);
            across[i] = std::sqrt(std::max(0.0, radius * radius - along[i] * along[i]));
            widest = std::max(widest, across[i]);
        }
    }

    [[nodiscard]] double reach(const glm::dvec3& normal, double radius) const
    {
        if (!is_known) return radius;
        const double cosine = std::abs(glm::dot(axis, normal));
        const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
        double most = 0.0;
        for (std::size_t i = 0; i < along.size(); ++i)
            most = std::max(most, cosine * along[i] + sine * across[i]);
        return std::min(most, radius);
    }
};

/// The data of one of the two shapes that a step of the search needs.
struct Mover {
    const SteadyBox& motion;
    bool turns = false;            // false for a sphere: it looks the same, however it turns
    double speed_of_turning = 0.0; // rad/s
    Whirl whirl;
    OrientedBox box; // the box at the present time

    Mover(const SteadyBox& its, double from, double to)
        : motion{its},
          turns{its.spin != glm::dvec3{0.0} && its.core_radius() > 0.0},
          speed_of_turning{length(its.spin)},
          whirl{its, to - from},
          box{its.at(from)}
    {}

    void go_to(double time)
    {
        if (turns)
            box = motion.at(time);
        else
            box.centre = motion.centre + time * motion.velocity;
        if (motion.is_part && !turns) box.centre += arm();
    }
    /// Returns the point that the box turns about.
    [[nodiscard]] glm::dvec3 pivot() const
    {
        return motion.is_part ? box.centre - arm() : box.centre;
    }
    /// Returns the velocity of the box's centre.
    [[nodiscard]] glm::dvec3 velocity() const
    {
        return motion.is_part ? motion.velocity + glm::cross(motion.spin, arm()) : motion.velocity;
    }
    /// Returns the greatest speed at which the centre of a part moves around the pivot, m/s.
    [[nodiscard]] double orbit_speed() const
    {
        return motion.is_part ? speed_of_turning * length(motion.arm) : 0.0;
    }
    [[nodiscard]] double reach_in_all_turns(const glm::dvec3& normal) const
    {
        if (!turns) return half_extent(box, normal);
        return whirl.reach(normal, motion.core_radius()) + motion.rounding;
    }

private:
    /// Returns the vector from the pivot to the box's centre, in the world's frame.
    [[nodiscard]] glm::dvec3 arm() const
    {
        return box.axes * (glm::transpose(motion.frame) * motion.arm);
    }
};

} // namespace hapnet::scene

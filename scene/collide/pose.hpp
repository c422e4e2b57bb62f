// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/forecast.hpp"
#include "scene/collide/mover.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace hapnet::scene {

// The squared sine of the angle below which two edges count as parallel. Then the axes of the faces
// suffice.
inline constexpr double parallel_sine2 = 1e-6;

/// Two boxes at a moment, in the frame of the first, and the rate at which they move. The 15 axes
/// of the separating axis theorem turn with the boxes that they belong to. Along each of them the
/// distance is |place| less the boxes' half shadows. Both are sums of products of this class's
/// members.
class Pose {
public:
    Pose(const Mover& a, const Mover& b) : a_{a}, b_{b}
    {
        const glm::dvec3 offset = b.box.centre - a.box.centre;
        const glm::dvec3 velocity = b.velocity() - a.velocity() - glm::cross(a.motion.spin, offset);
        const glm::dvec3 spin = b.motion.spin - a.motion.spin;
        offset_ = per_axis(offset * a.box.axes);
        velocity_ = per_axis(velocity * a.box.axes);
        for (const int j : {0, 1, 2}) {
            const glm::dvec3& axis = b.box.axes[j];
            const PerAxis turn = per_axis(axis * a.box.axes);
            const PerAxis turning = per_axis(glm::cross(spin, axis) * a.box.axes);
            for (const std::size_t i : {0U, 1U, 2U}) {
                turn_[i][static_cast<std::size_t>(j)] = turn[i];
                turning_[i][static_cast<std::size_t>(j)] = turning[i];
            }
        }
    }

    /// An axis along which the two boxes are apart.
    struct Open {
        double distance; // m
        double place;    // of the second box's centre along the axis, from the first's
        double length;   // length of the axis: 1, or the sine between two edges
        std::size_t axis;
    };
    struct OpenAxes {
        std::array<Open, 15> axes;
        std::size_t count = 0;
        std::size_t widest = 0;

        void consider(const Open& open, double more_than)
        {
            if (!(open.distance > more_than)) return;
            if (count == 0 || open.distance > axes[widest].distance) widest = count;
            axes[count++] = open;
        }
    };

    /// Finds the axes along which the two boxes are farther apart than `more_than`.
    void find_open(double more_than, OpenAxes& open) const
    {
        const PerAxis half_a = per_axis(a_.box.half);
        const PerAxis half_b = per_axis(b_.box.half);
        for (const std::size_t i : {0U, 1U, 2U}) {
            const double place = offset_[i];
            const double reach = half_a[i] + half_b[0] * std::abs(turn_[i][0]) +
                                 half_b[1] * std::abs(turn_[i][1]) +
                                 half_b[2] * std::abs(turn_[i][2]);
            open.consider({std::abs(place) - reach, place, 1.0, i}, more_than);
        }
        for (const std::size_t j : {0U, 1U, 2U}) {
            const double place =
                offset_[0] * turn_[0][j] + offset_[1] * turn_[1][j] + offset_[2] * turn_[2][j];
            const double reach = half_b[j] + half_a[0] * std::abs(turn_[0][j]) +
                                 half_a[1] * std::abs(turn_[1][j]) +
                                 half_a[2] * std::abs(turn_[2][j]);
            open.consider({std::abs(place) - reach, place, 1.0, 3 + j}, more_than);
        }
        for (const std::size_t i : {0U, 1U, 2U}) {
            const std::size_t i1 = (i + 1) % 3;
            const std::size_t i2 = (i + 2) % 3;
            for (const std::size_t j : {0U, 1U, 2U}) {
                const std::size_t j1 = (j + 1) % 3;
                const std::size_t j2 = (j + 2) % 3;
                const double square = 1.0 - turn_[i][j] * turn_[i][j];
                if (square < parallel_sine2) continue;
                const double place = offset_[i2] * turn_[i1][j] - offset_[i1] * turn_[i2][j];
                const double gap = std::abs(place) - half_a[i1] * std::abs(turn_[i2][j]) -
                                   half_a[i2] * std::abs(turn_[i1][j]) -
                                   half_b[j1] * std::abs(turn_[i][j2]) -
                                   half_b[j2] * std::abs(turn_[i][j1]);
                // The root is taken only where it matters.
                if (gap * std::abs(gap) <= more_than * std::abs(more_than) * square) continue;
                const double length = std::sqrt(square);
                open.consider({gap / length, place, length, 6 + 3 * i + j}, more_than);
            }
        }
    }

    /// Forecasts the room along an axis beyond a gap. It is valid as long as the centres are no
    /// farther apart than `apart`.
    [[nodiscard]] Forecast forecast(const Open& open, double gap, double apart) const
    {
        const double spin_a = a_.speed_of_turning;
        const double spin_b = b_.speed_of_turning;
        const double both = spin_a + spin_b;
        const double orbit_a = a_.orbit_speed();
        const double orbit_b = b_.orbit_speed();
        const double speed = length(b_.motion.velocity - a_.motion.velocity) + orbit_a + orbit_b;
        const PerAxis half_a = per_axis(a_.box.half);
        const PerAxis half_b = per_axis(b_.box.half);
        Forecast found;
        found.room = open.length * (open.distance - gap);
        double moves = 0.0;
        double halves = 0.0;
        double turns = both; // an upper bound of how fast the axis turns
        const auto add = [&](std::size_t k, double half, double turn, double turning) {
            found.parts[k] = half * turn;
            found.speeds[k] = half * turning;
            halves += half;
        };
        if (open.axis < 3) {
            const std::size_t i = open.axis;
            moves = velocity_[i];
            turns = spin_a;
            for (const std::size_t j : {0U, 1U, 2U}) add(j, half_b[j], turn_[i][j], turning_[i][j]);
        } else if (open.axis < 6) {
            const std::size_t j = open.axis - 3;
            turns = spin_b;
            for (const std::size_t i : {0U, 1U, 2U}) {
                moves += velocity_[i] * turn_[i][j] + offset_[i] * turning_[i][j];
                add(i, half_a[i], turn_[i][j], turning_[i][j]);
            }
        } else {
            const std::size_t i = (open.axis - 6) / 3;
            const std::size_t j = (open.axis - 6) % 3;
            const std::size_t i1 = (i + 1) % 3;
            const std::size_t i2 = (i + 2) % 3;
            const std::size_t j1 = (j + 1) % 3;
            const std::size_t j2 = (j + 2) % 3;
            moves = velocity_[i2] * turn_[i1][j] + offset_[i2] * turning_[i1][j] -
                    velocity_[i1] * turn_[i2][j] - offset_[i1] * turning_[i2][j];
            add(0, half_a[i1], turn_[i2][j], turning_[i2][j]);
            add(1, half_a[i2], turn_[i1][j], turning_[i1][j]);
            add(2, half_b[j1], turn_[i][j2], turning_[i][j2]);
            add(3, half_b[j2], turn_[i][j1], turning_[i][j1]);
            found.approach = std::abs(gap) * both; // the axis changes its length
        }
        found.approach += open.place < 0.0 ? moves : -moves;
        found.bend = both * both * halves + turns * (turns * apart + 2.0 * speed) +
                     spin_a * orbit_a + spin_b * orbit_b;
        return found;
    }

    /// Returns the axis in the world's frame, from the first box to the second.
    [[nodiscard]] glm::dvec3 normal(const Open& open) const
    {
        const double side = open.place < 0.0 ? -1.0 : 1.0;
        if (open.axis < 3) return side * a_.box.axes[static_cast<int>(open.axis)];
        if (open.axis < 6) return side * b_.box.axes[static_cast<int>(open.axis - 3)];
        return side / open.length *
               glm::cross(a_.box.axes[static_cast<int>((open.axis - 6) / 3)],
                          b_.box.axes[static_cast<int>((open.axis - 6) % 3)]);
    }

private:
    const Mover& a_;
    const Mover& b_;
    PerAxis offset_{};
    PerAxis velocity_{};
    std::array<PerAxis, 3> turn_{}; // [i][j]: axis j of the second box along axis i of the first
    std::array<PerAxis, 3> turning_{};
};

} // namespace hapnet::scene

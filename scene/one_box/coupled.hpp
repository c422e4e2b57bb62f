// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/motion.hpp"

namespace hapnet::scene {

// The box's motion within an interval, for independent axes and for axes that slanted springs
// couple.

/// Finds the modes of the axes that move, but not the trajectories of the modes.
void find_modes(BoxMotion& box);
/// Sets the trajectories of the modes from those of the axes.
void set_modes(BoxMotion& box);
/// As set_bounds(), but computed by the modes.
void set_coupled_bounds(BoxMotion& box);

[[nodiscard]] inline TrajectoryPoint motion_after(const BoxMotion& box, std::size_t axis,
                                                  double time)
{
    if (!box.is_coupled) return box.trajectories[axis].after(time);
    TrajectoryPoint sum;
    for (std::size_t j = 0; j < 3; ++j) {
        const TrajectoryPoint mode = box.room.coupled.modes[j].after(time);
        sum.displacement += box.room.coupled.direction[j][axis] * mode.displacement;
        sum.speed += box.room.coupled.direction[j][axis] * mode.speed;
    }
    return sum;
}

[[nodiscard]] inline double acceleration_after(const BoxMotion& box, std::size_t axis, double time)
{
    if (!box.is_coupled)
        return box.trajectories[axis].acceleration(time, box.trajectories[axis].after(time));
    double sum = 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
        const Trajectory& mode = box.room.coupled.modes[j];
        sum += box.room.coupled.direction[j][axis] * mode.acceleration(time, mode.after(time));
    }
    return sum;
}

/// Returns the first root of a quantity of the axes, in [from, to). The search counts in the budget
/// of the tick.
[[nodiscard]] RootSearch search_root(const BoxMotion& box, const WatchedQuantity& watched,
                                     double from, double to);

} // namespace hapnet::scene

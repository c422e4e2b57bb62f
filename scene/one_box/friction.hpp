// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/events.hpp"

namespace hapnet::scene {

// Coulomb's law with a circular cone. While the box slides straight on, friction is a steady force
// (or grows steadily with the load on the support), and the trajectories are exact. Where other
// forces bend the box's path, friction has the direction in the middle of the interval: second
// order.

/// Changes the trajectories of the interval by the dry friction of the box's support.
void add_friction(BoxMotion& box);

/// Replaces `first` by the stop of a box that slides, or by the slip of a box that sticks, if that
/// comes before `first`.
void find_friction_event(const BoxMotion& box, Event& first);

} // namespace hapnet::scene

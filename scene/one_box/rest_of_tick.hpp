// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/motion.hpp"

namespace hapnet::scene {

/// Runs what is left of a tick in one step, whatever happens in it. A spring pushes with the mean
/// of its force over the depths that it goes through (a discrete gradient), so that kinetic and
/// stored energy together grow by no more than hands and constant forces give, and no hand exceeds
/// its greatest force, however stiff it is. Impacts are inelastic. It never fails: a box that would
/// still pass an obstacle after a few tries stays where it is. Returns true if that was needed.
bool finish_tick(BoxMotion& box);

} // namespace hapnet::scene

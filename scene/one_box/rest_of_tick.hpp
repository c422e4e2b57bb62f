// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/motion.hpp"

namespace hapnet::scene {

/// Advances the box through the rest of a tick in one step, whatever happens in it. A spring pushes
/// with the mean of its force over the depths that it passes through (a discrete gradient). So
/// kinetic and stored energy together grow by no more than hands and constant forces give, and no
/// hand exceeds its greatest force, however stiff it is. Impacts are inelastic. The function never
/// fails: a box that would still pass through an obstacle after a few tries stays where it is.
/// Returns true if that was needed.
bool finish_tick(BoxMotion& box);

} // namespace hapnet::scene

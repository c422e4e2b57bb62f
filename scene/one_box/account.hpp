// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/motion.hpp"
#include "scene/state.hpp"

namespace hapnet::scene {

/// The state of the box at the start of a tick.
struct TickStart {
    PerAxis position{};
    PerAxis velocity{};
    PerAxis steady{};    // acceleration by gravity and pushes; 0 along locked axes
    double stored = 0.0; // J, in the springs of hands that hold the box
};

/// Corrects a tick that is not exact to rounding throughout, as a last safeguard. It acts where the
/// box has gained more energy than gravity, pushes, the hands' springs and the hands' own motion
/// gave, or where a hand has given more than its greatest force can give in a tick. Then all
/// impulses of the tick are scaled by one share, so that the velocity moves towards the one without
/// impulses. The hands report the scaled impulses. Such a share always exists: the gain is a convex
/// function of it, and not above 0 at 0.
void settle(const WorldConfig& config, WorldState& state, const TickStart& start, BoxMotion& box);

} // namespace hapnet::scene

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

/// The last line, for ticks that are not exact to rounding throughout. Where the box has gained
/// more energy than gravity, pushes, the hands' springs and the hands' own motion gave, or a hand
/// has given more than its greatest force can in a tick, all impulses of the tick are taken by one
/// share, which takes the velocity towards that without them; what the hands report is of the same
/// share. Such a share always exists: the gain is a convex function of it, and not above 0 at 0.
void settle(const WorldConfig& config, WorldState& state, const TickStart& start, BoxMotion& box);

} // namespace hapnet::scene

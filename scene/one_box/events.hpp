// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/motion.hpp"

namespace hapnet::scene {

/// What ends a stretch of a tick.
struct Event {
    enum class Kind : std::uint8_t {
        none,      // the end of the tick
        spring,    // a hand's spring comes into another phase
        impact,    // the box arrives at a fixed one or a plane
        unloading, // what carries it is not pressed any more
        edge,      // it slides off what carries it
        stop,      // friction has stopped it
        slip,      // friction does not hold it any more
    };
    double time = 0.0; // from the start of the stretch
    Kind kind = Kind::none;
    std::uint32_t spring = 0;
    SpringPhase phase = SpringPhase::apart; // the spring's next one
    std::size_t axis = 0;                   // of an impact, an unloading or an edge
    double face = 0.0;                      // where the centre is at an impact or an edge
    double side = 0.0;                      // of an impact: +1 at a high face
    const Obstacle* obstacle = nullptr;     // of an impact
};

/// Whether nothing but dry friction can end the stretch before the tick does: so it nearly always
/// is, and that is soon seen.
[[nodiscard]] bool is_uneventful(const BoxMotion& box);
/// What happens first in what is left of the tick, if it is before `first`.
void find_event(const BoxMotion& box, Event& first);

/// Lets it happen; the box has been advanced to its moment. `tick` is the whole one's length.
void apply(BoxMotion& box, const Event& event, double tick);

} // namespace hapnet::scene

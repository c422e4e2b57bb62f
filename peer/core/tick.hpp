// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/space.hpp"
#include "proto/record/rows.hpp"
#include "scene/world.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::peer {

/// A hand as its device reports it: the position of the haptic interface point, and whether the
/// hand grips.
struct Hand {
    base::Position hip;
    base::Velocity velocity;
    bool gripping = false;
    bool present = true; // a person holds the device, and its sample is valid
    double work_j = 0.0; // work of the hand on its device since the start
    base::Force felt{};  // force sent to the device in the previous tick
};

/// The phase of a session. The last 3 s of a session (or half of it, if it is shorter than 6 s) are
/// hands_off.
using record::Phase;

/// The result of one tick.
struct Tick {
    Phase phase = Phase::waiting;
    bool permitted = false; // whether the hand may feel anything at all
    base::Force force;      // force on the hand, before the governor
    scene::HandTouch touched;
    bool remote_touching = false;             // another peer's hand counts as touching
    base::Force remote_force;                 // sum of the other peers' forces that acted
    std::optional<base::Position> remote_hip; // another peer's hand, as the algorithm shows it
    double freshness = 0.0;                   // freshness of the others' newest state, 0 to 1
    std::uint32_t sequence = 0; // sequence of the state sent to the first other peer; 0: none
};

} // namespace hapnet::peer

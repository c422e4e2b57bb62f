// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/one_box/motion.hpp"

namespace hapnet::scene {

/// An event that ends an interval of a tick.
struct Event {
    enum class Kind : std::uint8_t {
        none,   // nothing before the end of the tick
        spring, // a hand's spring enters another phase
        slanted_spring,
        impact,    // the box arrives at a fixed box or a plane
        unloading, // the box no longer presses on its support
        edge,      // the box slides off its support
        stop,      // friction has stopped it
        slip,      // friction no longer holds the box
        unknown,   // the search for events was given up here
    };
    double time = 0.0; // from the start of the interval
    Kind kind = Kind::none;
    std::uint32_t spring = 0;               // index of the spring among those of its kind
    SpringPhase phase = SpringPhase::apart; // next phase of the spring
    std::size_t axis = 0;                   // axis of an impact, an unloading or an edge
    double face = 0.0;                      // position of the centre at an impact or an edge
    double side = 0.0;                      // at an impact: +1 at a high face, -1 at a low one
    const Obstacle* obstacle = nullptr;     // the obstacle of an impact
};

/// True if nothing but dry friction can end the interval before the end of the tick. That is nearly
/// always so, and quick to find out.
[[nodiscard]] bool is_uneventful(const BoxMotion& box);
/// Replaces `first` by the first event in the rest of the tick, if that comes before `first`.
void find_event(const BoxMotion& box, Event& first);
/// Replaces `first` by the event `what` at the root of a watched quantity, if the root comes before
/// `first`. Where the search for the root was given up, that becomes an event. Returns true if
/// there is a root.
bool expect(const BoxMotion& box, const WatchedQuantity& watch, double from, Event& first,
            const Event& what);
/// Returns the quantity to watch for an axis that rests on its support while slanted springs couple
/// it to the other axes: the acceleration that presses it on the support.
[[nodiscard]] WatchedQuantity watch_load(const BoxMotion& box, std::size_t axis);

/// Applies the event to the box. The box must have been advanced to the moment of the event. `tick`
/// is the length of the whole tick.
void handle_event(BoxMotion& box, const Event& event, double tick);

} // namespace hapnet::scene

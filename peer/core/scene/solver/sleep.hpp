// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/broadphase/neighbours.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hapnet::scene {

/// Who sleeps. A body that has been at rest for a tenth of a second, together with everything
/// movable that it touches, falls asleep: its velocity becomes exactly zero, its contacts keep
/// their impulses, and it costs nothing until it is woken. Fixed bodies connect nothing.
///
/// At rest: not faster than a limit that grows with the body's size and gravity, at its centre and
/// at its corners.
///
/// A tick: wake() whom a hand reaches or a push moves; wake_touched() once the manifolds are
/// known; at the end of the tick, with the contacts' memories written, rest().
class Sleep {
public:
    Sleep(const Frozen& frozen, const Bodies& bodies);

    /// Wakes a body and all that touches it, one through the other, and starts their time at rest
    /// anew. Nothing for a body that is awake but that. Slots change.
    template <Search search>
    void wake(BodyId body, Bodies& bodies, Neighbours<search>& neighbours);

    /// Wakes those asleep that an awake body which is not at rest touches according to `touching`
    /// (a pair's index: whether its manifold has points), and what touches them. Returns whether
    /// it woke anybody: then neighbours.pairs_added() has to be looked at, and this to be called
    /// again.
    template <Search search, typename Touching>
    bool wake_touched(Bodies& bodies, Neighbours<search>& neighbours, Touching touching);

    /// Counts the time at rest of the awake ones and puts islands to sleep. `ticks`: of the world.
    template <Search search>
    void rest(Bodies& bodies, Neighbours<search>& neighbours, std::uint64_t ticks);

    /// Its time at rest starts anew: a hand touches it.
    void keep_awake(BodyId body);
};

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"
#include "scene/collide/box_box.hpp"
#include "scene/collide/pairs.hpp"
#include "scene/state.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace hapnet::scene {

[[nodiscard]] OrientedBox box_of(const Bodies& bodies, Slot slot);
/// Returns the shape of one part of a body.
[[nodiscard]] OrientedBox shape_of(const Bodies& bodies, PartId part);

/// A box and its motion in the tick.
struct BoxSweep {
    const OrientedBox& box;
    glm::dvec3 velocity{0.0};
    double reach = 0.0;
    double radius = 0.0;    // greatest distance of the surface from the box's centre, m
    glm::dvec3 offset{0.0}; // from the body's centre to the box's
};

/// The contact of two boxes, and their bodies' centres at the time of the contact.
struct SweptContact {
    Manifold manifold;
    ContactPlaces centres;
    double first_touch = std::numeric_limits<double>::infinity(); // s, of boxes that go far; else
                                                                  // infinity
    bool may_pass = false; // the boxes go far, and may meet if they turn
};

/// Finds where two boxes touch or will touch within the tick. For boxes that go far in the tick, it
/// finds where they touch at their time of impact. The separation is then the distance that they
/// travel until that time, so that they cannot pass through each other.
[[nodiscard]] SweptContact collide_swept(const BoxSweep& a, const BoxSweep& b, double tick,
                                         BoxBoxMemory& memory);

/// The box of a body, or of one of its parts, and how far it may move in the tick.
struct SweptBox {
    OrientedBox box;
    // The orientation of the box's axes: the body's, or an earlier one that differs from it only by
    // rounding. Values that follow from the axes stay valid with it.
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    std::uint64_t turns = 0; // how often the axes were computed again
    double radius = 0.0;     // greatest distance of the surface from the box's centre, m
    glm::dvec3 offset{0.0};  // from the body's centre to the box's, m; 0 for a body of one part
    // An upper bound of how far any point of the box may move in the tick, m. For a sleeping body:
    // as if it were awake.
    double reach = 0.0;
    glm::dvec3 spin{0.0}; // angular velocity, rad/s
};

[[nodiscard]] inline BoxSweep sweep_of(const Bodies& bodies, PartId part, const SweptBox& now)
{
    const Slot slot = bodies.slot_of[part];
    const bool moves = slot < bodies.awake || (slot >= bodies.movable && slot < bodies.moving);
    return {now.box, bodies.velocity.at(slot), moves ? now.reach : 0.0, now.radius, now.offset};
}

/// The bodies' boxes at the start of a tick. They are computed on demand, and only for bodies that
/// have moved since. A body that flies alone costs nothing.
class SweptBoxes {
public:
    SweptBoxes(const Bodies& bodies, const Scales& scales);

    void begin_tick() { ++now_; }
    /// Forgets everything about a body that was put elsewhere.
    void forget(const Bodies& bodies, BodyId body);
    /// Returns the box of a part of a body. The reference is valid until the next tick.
    [[nodiscard]] const SweptBox& at(const Bodies& bodies, PartId part)
    {
        Entry& entry = entries_[part];
        if (entry.seen != now_) renew(bodies, part, entry);
        return entry.now;
    }

private:
    struct Entry {
        SweptBox now;
        std::uint64_t seen = 0;
    };

    void renew(const Bodies& bodies, PartId part, Entry& entry) const;

    Scales scales_;
    std::vector<Entry> entries_; // by PartId
    std::uint64_t now_ = 0;
};

} // namespace hapnet::scene

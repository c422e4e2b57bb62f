// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"
#include "scene/state.hpp"

#include <optional>

namespace hapnet::peer {

/// Dry friction between this peer's finger and a shared body that does not turn. A spring and a
/// damper act along the face, with the stiffness of the contact perpendicular to it, from the place
/// where the finger touched first. The force is at most the friction coefficient of the HIPs times
/// the contact's force; beyond that the anchor slips along (Hayward, Armstrong 2000). The world
/// does not model it: it is an external force on the body, and its opposite on the hand. It is
/// known at the start of a tick from the contact's force in the previous tick.
class FingerFriction {
public:
    explicit FingerFriction(const scene::HandDescription& hips) : hips_{hips} {}

    /// Returns the force on the body, which is constant during the coming tick. `hand` and `body`
    /// are the states at its start.
    [[nodiscard]] base::Force on_body(const scene::HandInput& hand, const scene::BodyState& body);
    /// Takes the world's contact in the tick for which on_body() was called.
    void on_touch(const scene::HandTouch& touch);

private:
    struct Contact {
        glm::dvec3 normal{0.0};             // unit vector into the body
        double force_n = 0.0;               // force along the normal
        std::optional<glm::dvec3> anchor{}; // the spring's anchor, relative to the body's centre
    };

    scene::HandDescription hips_;
    std::optional<Contact> contact_;
};

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"
#include "scene/state.hpp"

#include <optional>

namespace hapnet::peer {

/// Dry friction between this peer's finger and the shared body, which does not turn: a spring and
/// a damper along the face, as stiff as the contact across it, from where the finger touched first.
/// It gives at most the hips' friction times the contact's force; beyond that its anchor slips
/// along (Hayward, Armstrong 2000). The world knows nothing of it: it is a push on the body, known
/// at the start of a tick from the contact's force in the tick before, and its opposite on the
/// hand.
class FingerFriction {
public:
    explicit FingerFriction(const scene::HandDescription& hips) : hips_{hips} {}

    /// Returns the force on the body, to be held for the coming tick. `hand` and `body` are as they
    /// are now.
    [[nodiscard]] base::Force on_body(const scene::HandInput& hand, const scene::BodyState& body);
    /// The world's contact in the tick for whose start on_body() was called.
    void on_touch(const scene::HandTouch& touch);

private:
    struct Contact {
        glm::dvec3 normal{0.0};             // unit vector into the body
        double force_n = 0.0;               // force along the normal
        std::optional<glm::dvec3> anchor{}; // the spring's anchor, seen from the body's centre
    };

    scene::HandDescription hips_;
    std::optional<Contact> contact_;
};

} // namespace hapnet::peer

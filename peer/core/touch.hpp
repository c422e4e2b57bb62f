// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/contact.hpp"

#include <optional>

namespace hapnet::peer {

/// What a hand exerts and feels in one tick.
struct Touched {
    bool touching = false; // pushes or holds the movable cube
    bool holding = false;
    base::Force on_cube; // by the hand on the movable cube
    base::Force on_hand; // by both cubes on the hand
};

/// One hand against the two cubes: it pushes the movable one, or holds it while its owner grips
/// (then it also pulls), and feels the static one. Forces come from the start of the tick.
class Touch {
public:
    explicit Touch(const Scene& scene) : scene_{scene} {}

    /// `cube` and `cube_velocity` are the movable cube's.
    [[nodiscard]] Touched feel(const Hand& hand, const Box& cube, base::Velocity cube_velocity);

    /// Lets go of everything.
    void release() { held_at_.reset(); }

private:
    [[nodiscard]] base::Force pull(const Hand& hand, const Box& cube,
                                   base::Velocity cube_velocity) const;

    Scene scene_;
    SphereBoxContact movable_;
    SphereBoxContact static_;
    std::optional<base::Displacement> held_at_; // from the cube's centre to the hand
};

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/solver/contact_block.hpp"
#include "scene/state.hpp"

namespace hapnet::scene {

/// The motion of one kinematic body over a tick, known before it begins.
struct KinematicTick {
    BodyMotion start;
    BodyMotion end;
    BodyMotion mean;
    base::Position position{}; // at the end
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    bool moves = false;
};

/// The kinematic bodies' motions, in the order of their slots. While a tick lasts their lanes have
/// the mean velocities, so that everything is found on the way that they really go.
class Kinematics {
public:
    explicit Kinematics(const Bodies& bodies) : ticks_{std::size_t{bodies.moving - bodies.movable}}
    {}

    void begin_tick(const WorldConfig& config, WorldState& state);
    /// Puts them where they come to.
    void end_tick(WorldState& state);

    /// Of a slot in [movable, moving).
    [[nodiscard]] const KinematicTick& of(const Bodies& bodies, Slot slot) const
    {
        return ticks_[slot - bodies.movable];
    }

private:
    Scratch<KinematicTick> ticks_;
};

} // namespace hapnet::scene

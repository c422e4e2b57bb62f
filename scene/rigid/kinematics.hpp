// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/state.hpp"

#include <span>

namespace hapnet::scene {

/// The motion of one kinematic body over a tick, known before it begins.
struct KinematicTick {
    BodyMotion start;
    BodyMotion end;
    BodyMotion mean;
    BodyMotion change;         // from start to end, as far as that agrees with the mean
    base::Position position{}; // position at the end
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    bool moves = false;

    /// Returns the motion at a time within the tick: the mean, and the change about it.
    [[nodiscard]] BodyMotion motion_at(double time, double tick) const;
};

/// The kinematic bodies' motions, in the order of their slots. During a tick their lanes hold the
/// mean velocities, so that contacts are found on the paths that the bodies really take.
class Kinematics {
public:
    Kinematics(const Bodies& bodies, const Scales& scales)
        : scales_{scales}, ticks_{std::size_t{bodies.moving - bodies.movable}}
    {}

    void begin_tick(const WorldConfig& config, WorldState& state);
    /// Sets the motions of the kinematic bodies, which impulses do not change. They come after the
    /// awake bodies.
    void begin_contacts(const Bodies& bodies, ContactSolver& solver,
                        std::span<BodyIntegration> integrations) const;
    /// Moves the kinematic bodies to their places at the end of the tick.
    void end_tick(WorldState& state);

    /// Returns the tick of a slot in [movable, moving).
    [[nodiscard]] const KinematicTick& of(const Bodies& bodies, Slot slot) const
    {
        return ticks_[slot - bodies.movable];
    }
    /// True if a kinematic body goes so far in this tick that it could pass something.
    [[nodiscard]] bool any_far() const { return any_far_; }

private:
    Scales scales_;
    bool any_far_ = false;
    Scratch<KinematicTick> ticks_;
};

/// Adds the work of kinematic bodies on the bodies that they push and carry. The force of a contact
/// counts as constant over the tick or as a blow at its end, whichever gives more work.
void add_driven_energy(ContactSolver& solver, std::span<BodyIntegration> integrations);

} // namespace hapnet::scene

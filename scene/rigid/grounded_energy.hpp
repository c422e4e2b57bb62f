// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/rigid/continuous.hpp"
#include "scene/rigid/free_flight.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/state.hpp"

#include <span>

namespace hapnet::scene {

/// The energy of bodies that touch nothing but what stands still, with no hand, joint or torque on
/// them: whatever a floor does, kinetic energy grows by no more than the work of gravity and pushes
/// on the way that was gone. EnergyAccount sees the impulses, with the inertia that the body has
/// when the tick begins; this sees where the body came: what turned meanwhile, and what was lifted
/// out of an overlap, which its motion pays for as far as it goes.
struct GroundedEnergy {
    const WorldConfig& config;
    Bodies& bodies;
    const ActiveBodies& active;
    std::span<BodyIntegration> integrations; // by solver index

    /// Before bodies move: which of them are grounded, and what they have.
    void begin(const WorldState& state, ContactSolver& solver) const;
    /// After continuous collision: those that it let push each other are not.
    void leave_pushed(const ContinuousCollision& touches) const;
    /// Slows those that gained.
    void settle(const WorldState& state) const;
};

} // namespace hapnet::scene

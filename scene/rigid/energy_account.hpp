// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/rigid/hand_contacts.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/solver/islands.hpp"
#include "scene/state.hpp"

#include <cstdint>
#include <span>

namespace hapnet::scene {

/// The last word on a tick's impulses: no island of bodies that touch may gain more kinetic energy
/// than the work of gravity, pushes and torques, what its hands' springs had stored, and the work
/// of the own motion of hands and of kinematic bodies. Where it would, because bounces, stiff hands
/// and an unfinished solve each were right for another moment of the tick, all impulses of the
/// island are scaled by one share. Without impulses nothing is gained, and the gain is a convex
/// parabola over the share: there always is one. Momentum stays, and no force grows.
class EnergyAccount {
public:
    explicit EnergyAccount(std::size_t bodies);

    /// What a tick has come to.
    struct Tick {
        const WorldConfig& config;
        WorldState& state;
        const Scales& scales;
        std::span<const Slot> active;
        std::span<BodyIntegration> integrations; // by solver index
        ContactSolver& solver;
        HandContacts& hands;
    };

    /// Looks at all active bodies; changes the motions and impulses of the islands that gain.
    void settle(const Tick& tick);

private:
    /// Of a body, or the sum over an island, J.
    struct Balance {
        double gain = 0.0;   // with all impulses
        double linear = 0.0; // of that the part that grows with the share of the impulses ...
        double square = 0.0; // ... and that with its square
        double stored = 0.0; // what may be gained without impulses: what springs held, rounding
        double driven = 0.0; // with all impulses: the work of the motion of hands and kinematic
                             // bodies, and what is not followed of a turning body's inertia
        double detour =
            0.0; // of gravity, pushes and torques where the way is not the mean velocity's

        void add(const Balance& other);
        [[nodiscard]] bool is_exceeded() const { return gain > stored + driven + detour; }
        [[nodiscard]] double share() const;
    };

    [[nodiscard]] static Balance balance_of(const Tick& tick, Slot slot);
    static void scale(const Tick& tick, Slot slot, double share);
    void settle_islands(const Tick& tick);
    void leave_joined(const JointSolver& joints);

    Scratch<Balance> balances_; // by solver index; then by the first body of an island
    Islands islands_;
};

} // namespace hapnet::scene

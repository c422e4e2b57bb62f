// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/rigid/continuous.hpp"
#include "scene/rigid/free_flight.hpp"
#include "scene/rigid/hand_contacts.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/solver/islands.hpp"
#include "scene/state.hpp"

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
    explicit EnergyAccount(const Bodies& bodies);

    /// What a tick has come to.
    struct Tick {
        const WorldConfig& config;
        WorldState& state;
        const Scales& scales;
        const ActiveBodies& active;
        std::span<BodyIntegration> integrations; // by solver index
        ContactSolver& solver;
        HandContacts& hands;
    };

    /// Looks at all active bodies, before they move; changes the motions and impulses of the
    /// islands that gain.
    void settle(const Tick& tick);
    /// The same when they have moved, of those that continuous collision changed: by the way that
    /// they went at last. Their touches are impulses of the tick like all others.
    void settle_touches(const Tick& tick, const ContinuousCollision& touches);

private:
    struct BodyTick;
    struct Motion;
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
        bool is_settled = false; // there is nothing to be looked at

        void add(const Balance& other);
        [[nodiscard]] bool is_exceeded() const
        {
            return gain > stored + driven + detour && !is_settled;
        }
        [[nodiscard]] double share() const;
    };

    [[nodiscard]] static BodyTick tick_of(const Tick& tick, Slot slot);
    [[nodiscard]] static BodyTick moved_tick_of(const Tick& tick, Slot slot,
                                                const ContinuousCollision& touches);
    [[nodiscard]] static Motion motion_of(const Tick& tick, const BodyTick& body);
    [[nodiscard]] static double turning_slack(const Tick& tick, const BodyTick& body,
                                              const Motion& motion);
    [[nodiscard]] static Balance balance_of(const Tick& tick, const BodyTick& body);
    void join_islands(const Tick& tick, std::span<const Slot> slots);
    template <typename Scale>
    void scale_islands(const Tick& tick, std::span<const Slot> slots, Scale&& scale);

    Scratch<Balance> balances_; // by solver index; then by the first body of an island
    Islands islands_;
    Bounded<Slot> moved_;
};

} // namespace hapnet::scene

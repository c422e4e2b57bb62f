// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/maths/energy_share.hpp"
#include "scene/rigid/continuous.hpp"
#include "scene/rigid/driven_energy.hpp"
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
///
/// An island that touches something fixed and gains little beside its motion keeps its impulses:
/// all its velocities are scaled, which takes away less, and no contact that bore it.
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

    /// Which bodies, by solver index, are in an island that gains as it is; nothing when none is.
    [[nodiscard]] std::span<const std::uint8_t> gaining(const Tick& tick);
    /// Looks at all active bodies, before they move; changes the motions and impulses of the
    /// islands that gain. Returns whether any did.
    bool settle(const Tick& tick);
    /// The same when they have moved, of those that continuous collision changed: by the way that
    /// they went at last. Their touches are impulses of the tick like all others.
    void settle_touches(const Tick& tick, const ContinuousCollision& touches);
    /// After that: between two touches a body may be faster than at its ends, but not beyond what
    /// all the energy that there was can make it. Where it went farther in a tick in which a
    /// kinematic body touched any, as one that wedges it along its locks drives it, it stays where
    /// it began.
    void cut_ways(const Tick& tick, const ContinuousCollision& touches);

private:
    struct BodyTick;
    struct Motion;
    /// Of a body, or the sum over an island, J, with a share of the impulses.
    struct Balance {
        EnergyOfShare gain;   // less the work of gravity, pushes and torques
        double stored = 0.0;  // what may be gained without impulses: what springs held, rounding
        double given = 0.0;   // what by the impulses: by grips, by the motion of hands, by what is
                              // not followed of a turning inertia
        DrivenEnergy driven;  // by kinematic bodies
        double passed = 0.0;  // N s, of the impulses
        double detour = 0.0;  // of gravity, pushes and torques where the way is not the mean
                              // velocity's
        double share = 1.0;   // of the impulses
        double kinetic = 0.0; // J, at the end
        double slowing = 1.0; // of all velocities at the end
        bool is_held = false; // by something fixed, and nothing that moves by itself
        bool is_settled = false; // there is nothing to be looked at
        bool is_slowing = false; // how much slower it has to become is being looked for

        void add(const Balance& other);
        /// Without its sums.
        [[nodiscard]] Balance emptied() const
        {
            Balance empty;
            empty.share = share;
            empty.slowing = slowing;
            empty.is_held = is_held;
            empty.is_slowing = is_slowing;
            return empty;
        }
        /// J, by the impulses.
        [[nodiscard]] double given_at_most() const;
        /// By more than so much, J.
        [[nodiscard]] bool is_exceeded(double by = 0.0) const
        {
            return gain.at(share) > stored + given_at_most() + detour + by && !is_settled;
        }
        /// Slows what is held further, where that takes hardly any of its motion; whether it does.
        /// Its impulses are kept.
        [[nodiscard]] bool slow();
        /// The share with which it is not, were what is given so much for its share.
        [[nodiscard]] double share_within() const;
    };

    [[nodiscard]] static BodyTick tick_of(const Tick& tick, Slot slot);
    [[nodiscard]] static BodyTick moved_tick_of(const Tick& tick, Slot slot,
                                                const ContinuousCollision& touches);
    [[nodiscard]] static BodyTick slowed(BodyTick body, double slowing);
    [[nodiscard]] static glm::dvec3 spin_at_end(const Tick& tick, const BodyTick& body,
                                                const glm::dvec3& momentum);
    [[nodiscard]] static Motion motion_of(const Tick& tick, const BodyTick& body);
    [[nodiscard]] static double turning_slack(const Tick& tick, const BodyTick& body,
                                              const Motion& motion, double share);
    [[nodiscard]] static double given_by_grips(const Tick& tick, const BodyTick& body,
                                               const Motion& motion, double share);
    [[nodiscard]] static double passed(const Tick& tick, const BodyTick& body,
                                       const Motion& motion);
    [[nodiscard]] static DrivenEnergy with_squeezing(const Tick& tick, const DrivenEnergy& driven);
    [[nodiscard]] static Balance balance_of(const Tick& tick, const BodyTick& body,
                                            double share = 1.0);
    void join_islands(const Tick& tick, std::span<const Slot> slots);
    void sum_islands(const Tick& tick, std::span<const Slot> slots);
    void leave_joined(const JointSolver& joints);
    void find_held(const Tick& tick);
    template <typename TickOf>
    void slow_held(const Tick& tick, std::span<const Slot> slots, TickOf&& tick_of_slot);
    template <typename TickOf>
    void find_shares(const Tick& tick, std::span<const Slot> slots, TickOf&& tick_of_slot);
    template <typename Scale>
    bool scale_islands(const Tick& tick, std::span<const Slot> slots, Scale&& scale);

    Scratch<Balance> balances_;     // by solver index; then by the first body of an island
    Scratch<std::uint8_t> gaining_; // by solver index
    Islands islands_;
    Bounded<Slot> moved_;
};

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/rigid/continuous.hpp"
#include "scene/rigid/free_flight.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/solver/islands.hpp"
#include "scene/state.hpp"

#include <span>

namespace hapnet::scene {

/// The energy check of a tick. An island is a set of bodies that touch. It may have at most its
/// former kinetic energy, plus the work of gravity, pushes and torques along the paths of its
/// bodies, plus the energy that hands and kinematic bodies gave it. All terms are computed from the
/// bodies' final places, with their inertia there, whichever stage moved them.
///
/// An island that has more is slowed. Where it touches something fixed, all its velocities shrink
/// by one factor. Where nothing holds it, its velocities approach those of a rigid body with its
/// momentum and angular momentum, so that both are conserved.
class IslandEnergy {
public:
    explicit IslandEnergy(const Bodies& bodies);

    /// A tick, before or after its bodies have moved.
    struct Tick {
        const WorldConfig& config;
        WorldState& state;
        const Scales& scales;
        const ActiveBodies& active;
        std::span<BodyIntegration> integrations; // by solver index
        ContactSolver& solver;
    };

    /// Returns marks of the bodies, by solver index, in islands to which the velocities of the
    /// solver would give more energy than is allowed. Returns an empty span when there are none.
    [[nodiscard]] std::span<const std::uint8_t> gaining(const Tick& tick);

    /// Remembers the state of the active bodies before they move.
    static void begin(const Tick& tick);
    /// Slows the islands that gained. `touches` is null where continuous collision changed nothing.
    void settle(const Tick& tick, const ContinuousCollision* touches);

private:
    /// Sums over an island, or a body's part of them.
    struct Account {
        double allowed = 0.0;   // J, without what kinematic bodies gave
        DrivenEnergy driven{};  // energy that kinematic bodies gave
        double passed = 0.0;    // N s: the momentum that impulses left in the bodies
        double motion = 0.0;    // N s: sum of the sizes of the bodies' momenta
        double kinetic = 0.0;   // J: kinetic energy at the end
        double there = 0.0;     // J: sum of the sizes of the energies, for tolerances
        double rest = 0.0;      // J: energy of bodies at speeds that count as rest
        bool is_held = false;   // held by something fixed or kinematic, or along a locked axis
        bool is_driven = false; // pushed by something kinematic
        bool is_near = false;   // something fixed or kinematic may have been in the way
        bool has_hands = false;
        bool can_turn = true;  // the island can turn as a whole
        double lifted = 0.0;   // J: energy of being lifted out of overlaps
        glm::dvec3 stray{0.0}; // kg m: how far the centre is from where its momentum leads
        glm::dvec3 momentum{0.0}, moment{0.0}; // kg m/s; kg m: sum of mass times place
        glm::dvec3 angular{0.0};               // kg m^2/s, about the origin of the world
        double mass = 0.0;
        glm::dmat3 inertia{0.0}; // kg m^2, about the centre
        double share = 1.0;      // share kept of the velocities beside those of the rigid body
        // The momenta at the start. They are used where nothing but gravity acts from outside.
        glm::dvec3 momentum_before{0.0}, moment_before{0.0}, angular_before{0.0};
        bool is_closed = true;
        // The motion of the island as one rigid body, and the spin that conserves its angular
        // momentum.
        glm::dvec3 centre{0.0}, velocity{0.0}, spin{0.0}, spin_due{0.0};

        void add(const Account& other);
        /// Returns the energy that is allowed with a share of the velocities, J.
        [[nodiscard]] double allowed_at(double of_velocities) const
        {
            return allowed + driven.within(std::max(0.0, passed - (1.0 - of_velocities) * motion));
        }
    };

    [[nodiscard]] static Account velocities_of(const Tick& tick, Slot slot);
    [[nodiscard]] static Account outcome_of(const Tick& tick, const ContinuousCollision* touches,
                                            Slot slot);
    /// Returns an island's angular momentum about its centre.
    [[nodiscard]] static glm::dvec3 about_centre(const Account& island);
    /// The state of a body before it moved.
    struct Start {
        glm::dvec3 position{0.0};
        glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
        glm::dvec3 velocity{0.0};
        glm::dvec3 angular_momentum{0.0};
    };
    [[nodiscard]] static Start start_of(const Tick& tick, const ContinuousCollision* touches,
                                        Slot slot);
    [[nodiscard]] static bool gains(const Account& account);
    bool find_gaining(const Tick& tick, const ContinuousCollision* touches);
    void mend_ways(const Tick& tick, const ContinuousCollision* touches);
    void join_islands(const Tick& tick, std::span<const Slot> slots);
    void note_held(const Tick& tick);
    void sum_islands(std::span<const Slot> slots);
    void find_rigid(const Tick& tick, std::span<const Slot> slots);
    static void find_share(Account& island, Interventions& interventions);
    void slow(const Tick& tick, Slot slot);
    void cut_way(const Tick& tick, const ContinuousCollision* touches, Slot slot);

    Scratch<Account> accounts_;     // by solver index; then by the first body of an island
    Scratch<std::uint8_t> gaining_; // by solver index
    Islands islands_;
    Bounded<Slot> slots_; // the bodies whose outcome is checked
};

} // namespace hapnet::scene

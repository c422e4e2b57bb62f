// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/rigid/integrate.hpp"
#include "scene/rigid/joints.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/solver/islands.hpp"
#include "scene/state.hpp"

#include <span>
#include <vector>

namespace hapnet::scene {

/// The energy account of islands that have joints, at the very end of a tick: of the places and
/// velocities that came out, with what the joints' springs hold. Where an island has gained, its
/// motion is slowed. Scaled impulses would pull joints apart; instead, all velocities come nearer
/// to those of a rigid body with the island's momentum and angular momentum, or to rest where the
/// island is held from outside. Both fit every joint and every contact, so what lies between them
/// does, too.
///
/// Where all motion is not enough, because a stiff spring was bent without a force that it had, the
/// bodies of its joints go back to where they began; a guard, and counted as one.
///
/// What joints alone lose by errors of the method in one tick, they may gain by them in another:
/// so a pendulum that swings for long neither gains nor, tick by tick, loses.
class JointEnergy {
public:
    JointEnergy() = default;
    JointEnergy(const Bodies& bodies, std::size_t groups);

    /// Remembers where bodies are and how they move.
    void begin_tick(const WorldState& state);

    struct Tick {
        const WorldConfig& config;
        WorldState& state;
        std::span<const Slot> active;
        std::span<const BodyIntegration> integrations; // by solver index
        ContactSolver& solver;
        Joints& joints;
        bool is_one_island = false; // something was hit on its way: by what is not followed
    };
    void settle(const Tick& tick);

private:
    struct Departure {
        glm::dvec3 position{0.0};
        glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
        glm::dvec3 velocity{0.0};
        glm::dvec3 angular_momentum{0.0};
        double energy = 0.0; // kinetic, J
        bool is_active = false;
    };
    /// Of an island.
    struct Account {
        double gain = 0.0;    // J, more than it was given
        double there = 0.0;   // J, of all that was added up
        double kinetic = 0.0; // J, at the end
        bool has_joints = false;
        bool has_hands = false;
        bool is_clean = true;   // nothing but joints acts in it
        bool is_little = false; // what it gained
        bool is_held = false;   // from outside, or along an axis
        bool turns_freely = true;
        // For the rigid body.
        double mass = 0.0;
        glm::dvec3 momentum{0.0};
        glm::dvec3 momentum_due{0.0}; // by what acts from outside, but for hands
        glm::dvec3 velocity{0.0}, centre{0.0}, spin{0.0};
    };

    [[nodiscard]] static double kinetic_energy_as_at(const Departure& from, const Bodies& bodies,
                                                     Slot slot);
    void find_islands(const Tick& tick);
    void add(const Tick& tick, Slot slot);
    void add_groups(const Tick& tick);
    void add_all(const Tick& tick);
    [[nodiscard]] static double little_of(const Tick& tick, const Account& island);
    static double book(const Tick& tick, Account& island, double& owed);
    double find_rigid(const Tick& tick, Account& island, std::uint32_t root);
    void slow(const Tick& tick, Account& island, std::uint32_t root, double excess);
    void put_back(const Tick& tick, std::uint32_t root);
    [[nodiscard]] std::uint32_t root_of(const Tick& tick, Slot slot);

    std::vector<Departure> departures_{}; // by id
    std::vector<double> owed_{};          // J, by group: < 0: what errors have lost
    std::vector<Account> accounts_{};     // by the first solver index of an island
    Islands islands_{0};
};

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/pair_finder.hpp"
#include "scene/collide/sweep.hpp"
#include "scene/rigid/continuous.hpp"
#include "scene/rigid/free_flight.hpp"
#include "scene/rigid/hand_contacts.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/rigid/island_energy.hpp"
#include "scene/rigid/kinematics.hpp"
#include "scene/rigid/restitution.hpp"
#include "scene/rigid/sleep.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/solver/plane_contact.hpp"
#include "scene/state.hpp"

#include <vector>

namespace hapnet::scene {

/// Bodies that rotate, rest on each other and are pushed by hands; step() names the stages in
/// order.
///
/// Contact forces are constant over a tick: last tick's forces (warm start) plus the changes by the
/// solver, which prevent penetration at the tick's end. So bodies that rest, slide straight on or
/// are pushed steadily move exactly. Bounces happen at their moment within the tick. Overlaps are
/// corrected without a gain of speed.
template <BroadPhase broad_phase>
class RigidStepper {
public:
    /// Fixed bodies and hands have to be found even where there is only one movable body.
    static constexpr BroadPhase search =
        broad_phase == BroadPhase::grid ? BroadPhase::grid : BroadPhase::all_pairs;

    RigidStepper(const Description& description, const WorldConfig& config,
                 const WorldState& state);

    void step(const WorldConfig& config, WorldState& state);
    void on_body_placed(WorldState& state, BodyId body);
    void on_body_shifted(WorldState& state, BodyId body);
    void wake(WorldState& state, BodyId body);
    /// Returns the greatest cost that a tick can have.
    [[nodiscard]] TickCost tick_cost_bound(const WorldConfig& config) const;

    /// Counts of the work done, for tests and measurements.
    struct Counts {
        std::uint64_t contacts_left_out = 0; // contacts beyond the bound
        std::uint64_t steady_ticks = 0;      // ticks that went on as the tick before
        std::uint32_t contacts = 0;          // contacts of the last tick
        std::uint32_t sweeps = 0;            // sweeps of the last tick
        double change = 0.0;                 // m/s: change by the last sweep
    };
    [[nodiscard]] const Counts& counts() const { return counts_; }
    [[nodiscard]] const PairFinder<search>& pairs() const { return pairs_; }

private:
    // Replaces the stages in a tick that goes on as the last one. Returns false if the stages are
    // needed.
    bool step_steadily(const WorldConfig& config, WorldState& state);
    [[nodiscard]] bool finds_the_same(const WorldConfig& config, WorldState& state);
    [[nodiscard]] bool can_be_steady(const WorldConfig& config, const WorldState& state) const;
    void look_for_steadiness(const WorldConfig& config, const WorldState& state);

    // The stages of a step, in their order.
    void update_pairs(const WorldState& state);
    void collide_hands(const WorldConfig& config, WorldState& state);
    void wake_disturbed(WorldState& state);
    void begin_contacts(const WorldState& state);
    void collide_planes(const WorldConfig& config, WorldState& state);
    void collide_bodies(const WorldConfig& config, WorldState& state);
    void set_locked_load(const WorldConfig& config, const WorldState& state, Slot slot,
                         ContactBlock& block);
    bool solve_velocities(TickCost& cost);
    void integrate_hand_springs_on(const WorldConfig& config, WorldState& state,
                                   const HandContacts::Spring& spring);
    void set_mean_motions();
    void solve_anew_what_gains(const WorldConfig& config, WorldState& state);
    void integrate_velocities(const WorldConfig& config, WorldState& state);
    void store_contact_impulses(const WorldState& state);
    bool correct_positions(WorldState& state);
    bool hold_back(WorldState& state);
    IslandEnergy::Tick energy_tick(const WorldConfig& config, WorldState& state)
    {
        return {config, state, scales_, active_, integrations_.all(), solver_};
    }
    void integrate_positions(const WorldConfig& config, WorldState& state);
    void integrate_free_bodies(WorldState& state);
    void solve_continuous(const WorldConfig& config, WorldState& state);
    void report_hand_forces(const WorldConfig& config, WorldState& state);
    void update_sleep(WorldState& state);

    [[nodiscard]] SolverLimits velocity_limits() const;
    [[nodiscard]] SolverLimits position_limits() const;
    void activate(const Bodies& bodies, Slot slot);
    template <typename AreTouching>
    void wake_carried(WorldState& state, const AreTouching& are_touching);
    [[nodiscard]] SolverIndex index_of(const Bodies& bodies, Slot slot) const;
    [[nodiscard]] SweptContact collide_pair(const WorldState& state, Pair& pair);
    ContactBlock* add_contact(std::uint32_t points, ContactMemory& memory);
    void set_least_speeds(ContactBlock& block);
    void set_least_ways(ContactBlock& block);
    void integrate_hand_springs(const WorldConfig& config, WorldState& state);

    Scales scales_;
    PairFinder<search> pairs_;
    Sleep sleep_;
    HandContacts hand_contacts_;
    Scratch<PressedModes> modes_; // by the first hand on the body that is pressed
    SweptBoxes boxes_;
    FreeBodies free_bodies_;
    ActiveBodies active_;
    Kinematics kinematics_;
    Scratch<PlaneContact> plane_contacts_;  // in the order of the pairs with planes
    Scratch<BodyIntegration> integrations_; // by solver index; of active and kinematic bodies
    ContactSolver solver_;
    Restitution restitution_;
    IslandEnergy energy_;
    ContinuousCollision continuous_;
    /// The results of the last tick for a tick that goes on as the last one. All other results stay
    /// where the last tick left them.
    struct Steady {
        bool is_possible = false; // the scene allows steady ticks
        bool is_likely = false;   // the last tick was in balance
        BodyId body = 0;
        std::uint64_t turns = 0; // see SweptBox::turns
        BodyDynamics dynamics;
    };
    Steady steady_;
    bool any_far_ = false; // some body could pass another in this tick
    bool any_round_;       // some body is a sphere or a capsule
    Counts counts_;
};

extern template class RigidStepper<BroadPhase::none>;
extern template class RigidStepper<BroadPhase::all_pairs>;
extern template class RigidStepper<BroadPhase::grid>;

} // namespace hapnet::scene

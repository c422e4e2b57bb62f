// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/pair_finder.hpp"
#include "scene/collide/sweep.hpp"
#include "scene/rigid/free_flight.hpp"
#include "scene/rigid/hand_contacts.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/rigid/sleep.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/state.hpp"

#include <type_traits>
#include <vector>

namespace hapnet::scene {

/// Bodies that turn, rest on each other and are pushed by hands.
///
/// A tick: contacts where the bodies are; everyone's course under gravity, pushes, hands, and last
/// tick's contact forces, held constant; what these have to change so that nothing goes into
/// anything at the tick's end, again as constant forces: so what rests, slides or is pushed
/// steadily moves exactly. Bounces happen at their moment within the tick. What overlaps is moved
/// apart without gaining speed.
template <BroadPhase broad_phase>
class RigidStepper {
public:
    RigidStepper(const Description& description, const WorldConfig& config,
                 const WorldState& state);

    void step(const WorldConfig& config, WorldState& state);
    void on_body_placed(WorldState& state, BodyId body);

    /// What was done, for tests and measurements.
    struct Counts {
        std::uint64_t contacts_left_out = 0; // beyond the bound
        std::uint32_t contacts = 0;          // of the last tick
        std::uint32_t sweeps = 0;            // of the last tick
        double change = 0.0;                 // m/s, of the last sweep
    };
    [[nodiscard]] const Counts& counts() const { return counts_; }

private:
    /// Fixed bodies and hands have to be found, too, where there is but one movable body.
    static constexpr BroadPhase search =
        broad_phase == BroadPhase::grid ? BroadPhase::grid : BroadPhase::all_pairs;
    static constexpr bool sleeps = broad_phase != BroadPhase::none;
    struct NoSleep {
        NoSleep(const WorldConfig& /*config*/, const Bodies& /*bodies*/) {}
    };

    void collide_hands(const WorldConfig& config, WorldState& state);
    void wake_touched(WorldState& state);
    void begin_solver(const Bodies& bodies);
    void activate(const Bodies& bodies, Slot slot);
    void collide_planes(const WorldConfig& config, const WorldState& state);
    void collide_bodies(const WorldState& state);
    [[nodiscard]] SweptContact collide_pair(const WorldState& state, Pair& pair);
    ContactBlock* add_contact(const Manifold& manifold, const ContactPlaces& centres,
                              ContactMemory& memory);
    void warm_start();
    void integrate_velocities(const WorldConfig& config, const WorldState& state);
    void integrate_hand_springs(const WorldConfig& config, const WorldState& state);
    void solve_velocities(const WorldState& state);
    void correct_positions();

    Scales scales_;
    bool bounces_ = false;
    PairFinder<search> pairs_;
    std::conditional_t<sleeps, Sleep, NoSleep> sleep_;
    HandContacts hand_contacts_;
    SweptBoxes boxes_;
    FreeBodies free_bodies_;
    ActiveBodies active_;
    Scratch<BodyIntegration> integrations_; // by solver index; of those engaged
    ContactSolver solver_;
    std::array<HandSpring, hands_max> springs_{}; // on one body
    std::array<SpringImpulse, hands_max> work_{};
    Counts counts_;
};

extern template class RigidStepper<BroadPhase::none>;
extern template class RigidStepper<BroadPhase::all_pairs>;
extern template class RigidStepper<BroadPhase::grid>;

} // namespace hapnet::scene

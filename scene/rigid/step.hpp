// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/boxes.hpp"
#include "scene/collide/nearby.hpp"
#include "scene/collide/neighbours.hpp"
#include "scene/rigid/active_bodies.hpp"
#include "scene/rigid/free_flight.hpp"
#include "scene/rigid/hand_contacts.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/rigid/sleep.hpp"
#include "scene/solver/contact_solver.hpp"
#include "scene/state.hpp"

#include <type_traits>
#include <vector>

namespace hapnet::scene {

/// How the movable bodies of a rigid tick meet each other.
enum class Crowd : std::uint8_t { lone, few, many };

/// Bodies that turn, rest on each other and are pushed by hands.
///
/// A tick: contacts where the bodies are; everyone's course under gravity, pushes, hands, and last
/// tick's contact forces, held constant; what these have to change so that nothing goes into
/// anything at the tick's end, again as constant forces: so what rests, slides or is pushed
/// steadily moves exactly. Bounces happen at their moment within the tick. What overlaps is moved
/// apart without gaining speed.
template <Crowd crowd>
class RigidTick {
public:
    RigidTick(const Description& description, const Frozen& frozen, const Stage& stage);

    void tick(const Frozen& frozen, Stage& stage);
    void disturbed(Stage& stage, BodyId body);

    /// What was done, for tests and measurements.
    struct Counts {
        std::uint64_t contacts_left_out = 0; // beyond the bound
        std::uint32_t contacts = 0;          // of the last tick
        std::uint32_t sweeps = 0;            // of the last tick
        double change = 0.0;                 // m/s, of the last sweep
    };
    [[nodiscard]] const Counts& counts() const { return counts_; }

private:
    static constexpr Search search = crowd == Crowd::many ? Search::grid : Search::scan;
    static constexpr bool sleeps = crowd != Crowd::lone;
    struct NoSleep {
        NoSleep(const Frozen& /*frozen*/, const Bodies& /*bodies*/) {}
    };

    void feel(const Frozen& frozen, Stage& stage);
    void wake(Stage& stage);
    void look(const Bodies& bodies);
    void engage(const Bodies& bodies, Slot slot);
    void meet_planes(const Frozen& frozen, const Stage& stage);
    void meet_bodies(const Stage& stage);
    [[nodiscard]] BoxMeeting between(const Stage& stage, Pair& pair);
    ContactBlock* meet(const Manifold& manifold, const ContactPlaces& centres,
                       ContactMemory& memory);
    void carry();
    void set_out(const Frozen& frozen, const Stage& stage);
    void push_by_hands(const Frozen& frozen, const Stage& stage);
    void solve(const Stage& stage);
    void move_apart();

    Scales scales_;
    bool bounces_ = false;
    Neighbours<search> neighbours_;
    std::conditional_t<sleeps, Sleep, NoSleep> sleep_;
    HandSprings hands_;
    Boxes boxes_;
    Fliers fliers_;
    Engaged engaged_;
    Scratch<BodyCourse> courses_; // by solver index; of those engaged
    ContactSolver solver_;
    std::array<HipSpring, hips_max> springs_{}; // on one body
    std::array<HipWork, hips_max> work_{};
    Counts counts_;
};

using LoneTick = RigidTick<Crowd::lone>;
using FewTick = RigidTick<Crowd::few>;
using ManyTick = RigidTick<Crowd::many>;

extern template class RigidTick<Crowd::lone>;
extern template class RigidTick<Crowd::few>;
extern template class RigidTick<Crowd::many>;

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/collide/pair_finder.hpp"
#include "scene/collide/time_of_impact.hpp"
#include "scene/rigid/flight.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/rigid/kinematics.hpp"
#include "scene/rigid/touch.hpp"
#include "scene/state.hpp"

#include <span>
#include <vector>

namespace hapnet::scene {

/// Looks at the way that fast bodies have gone in a tick, and lets none pass through another, for
/// any orientation and spin (continuous collision detection).
///
/// The contacts of a tick know one touch of two bodies. What the impulse leaves may still go into
/// the wall, on a spin: a cube that hits with a corner. So the way of every body that went farther
/// than it could without passing something, turning included, is searched by conservative
/// advancement. At a touch that is still approaching, both bodies get an impulse at that moment,
/// with restitution and friction, and go on; in the order of time, for all of them. A body that
/// touches too often in one tick stays where it is for the rest of it and keeps its velocity.
///
/// In a tick: begin() before bodies move, solve() after. Neither when no body goes far.
class ContinuousCollision {
public:
    ContinuousCollision(const WorldConfig& config, const Bodies& bodies, const Scales& scales);

    /// Remembers where the awake bodies are, and how those that something acts on will turn.
    void begin(const Bodies& bodies, std::span<const Slot> active,
               std::span<const BodyIntegration> integrations, ContactSolver& solver);

    struct Surroundings {
        const WorldConfig& config;
        WorldState& state;
        const Kinematics& kinematics; // still where they began, with their mean velocities
    };
    /// Corrects what went through something. Sleepers that are hit move on at once; woken() says
    /// which, to be woken.
    template <BroadPhase search>
    void solve(const Surroundings& around, std::span<const Slot> active,
               const PairFinder<search>& pairs);
    /// Looks at two bodies in a tick, at most; and in the last solve().
    [[nodiscard]] std::uint64_t looks_max() const { return steps_max_; }
    [[nodiscard]] std::uint64_t looks() const { return steps_max_ - steps_left_; }
    [[nodiscard]] std::span<const BodyId> woken() const { return woken_.all(); }

private:
    using FlyerIndex = std::uint32_t;
    using MeetingIndex = std::uint32_t;
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// Where a body was, and how it turned from there.
    struct Departure {
        enum class Turn : std::uint8_t { free, steady, by_hands };
        glm::dvec3 position{0.0};
        glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
        Turn turn = Turn::free;
        glm::dvec3 spin{0.0}; // when it is steady
        BodyMotion start;
        FirstTouch first_touch;
    };
    /// A body that goes far, or that one such may meet.
    struct Flyer {
        BodyId body = 0;
        bool is_movable = false;
        bool is_kinematic = false;
        bool is_fast = false;     // others in its way are looked for
        bool is_released = false; // it goes on with its velocity at the end of the tick
        bool has_stopped = false; // for the rest of the tick
        bool has_changed = false; // it does not come to where it was put
        std::uint32_t touches = 0;
        MeetingIndex first = none;
        double bend = 0.0; // s: when it goes on with that velocity at the latest
        SteadyBox flight;  // time 0 is the start of the tick
        Roll roll;
        Aabb searched{glm::dvec3{1.0}, glm::dvec3{-1.0}}; // for others in its way
    };
    /// Two that may touch: a flyer and another, or a plane.
    struct Meeting {
        FlyerIndex a = 0;
        std::uint32_t b = 0;
        bool is_plane = false;
        bool is_over = false;  // they surely do not touch any more in this tick
        double time = 0.0;     // s: ... until then
        double gap = 0.0;      // m: at which they touch; an overlap
        double smallest = 0.0; // m: the smallest half edge of the two
        MeetingIndex next_of_a = none;
        MeetingIndex next_of_b = none;
    };
    template <BroadPhase search>
    bool go_to_next_touch(const Surroundings& around, const PairFinder<search>& pairs);

    FlyerIndex add_flyer(const Surroundings& around, BodyId body);
    [[nodiscard]] SteadyBox chord(const Bodies& bodies, Slot slot) const;
    [[nodiscard]] bool goes_far(const SteadyBox& flight, double time) const;
    [[nodiscard]] bool got_past(const Bodies& bodies, const Departure& departure, Slot slot) const;
    [[nodiscard]] bool has_to_bend(const Bodies& bodies, FlyerIndex index);
    [[nodiscard]] FlyerIndex next_bend(double time) const;
    void bend(const Surroundings& around, FlyerIndex index);
    void release(const Surroundings& around, Flyer& flyer, double time);
    void stop(Flyer& flyer, double time);
    void stop_all(const Surroundings& around, double time);

    template <BroadPhase search>
    void find_others(const Surroundings& around, const PairFinder<search>& pairs, FlyerIndex index,
                     double time);
    [[nodiscard]] bool are_to_meet(FlyerIndex a, std::uint32_t b, bool is_plane) const;
    void add_meeting(const Surroundings& around, const Meeting& meeting);
    template <typename Visit>
    void for_meetings_of(FlyerIndex index, Visit visit);
    [[nodiscard]] MeetingIndex earliest() const;

    void advance(const Surroundings& around, Meeting& meeting, double from);
    void advance_all(const Surroundings& around, FlyerIndex index, double from, FlyerIndex done);
    void touch(const Surroundings& around, Meeting& meeting);
    [[nodiscard]] Toucher toucher(const Surroundings& around, const Flyer& flyer,
                                  double time) const;
    bool exchange_impulse(const Surroundings& around, const Meeting& meeting);

    Scales scales_;
    Scratch<Departure> departures_; // by slot
    Scratch<Flyer> flyers_;
    Scratch<Meeting> meetings_;
    std::vector<FlyerIndex> flyer_of_; // by id; `none` between ticks
    Bounded<BodyId> woken_;
    std::uint32_t steps_max_ = 0; // looks at two bodies in a tick
    std::uint32_t steps_left_ = 0;
};

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/collide/advancement.hpp"
#include "scene/collide/pair_finder.hpp"
#include "scene/rigid/cluster.hpp"
#include "scene/rigid/driven_energy.hpp"
#include "scene/rigid/flight.hpp"
#include "scene/rigid/integrate.hpp"
#include "scene/rigid/kinematics.hpp"
#include "scene/rigid/touch.hpp"
#include "scene/state.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace hapnet::scene {

/// Continuous collision detection: examines the paths of fast bodies in a tick and lets no body
/// pass through another, for any orientation and spin.
///
/// The contacts of a tick cover one touch of two bodies. The motion after their impulse may still
/// lead into the wall because of the spin, as when a cube hits with a corner. So the path of every
/// body that moved so far that it could pass something, turning included, is searched by
/// conservative advancement. At a touch whose bodies still approach, both get an impulse at that
/// moment, with restitution and friction, and go on. All touches are handled in the order of time.
///
/// Where many fast bodies are packed, touches would have no end. So bodies that touch too often in
/// one tick stick together (Cluster). From then on they have one motion, as after an inelastic
/// impact, and they lose their speed against a wall that they touch. Each such step removes one
/// body or one direction, so there are few steps, and bodies of one motion need only one search.
///
/// In each tick call begin() before bodies move and solve() after. Call neither when no body goes
/// far.
class ContinuousCollision {
public:
    ContinuousCollision(const WorldConfig& config, const Bodies& bodies, const Scales& scales);

    /// Remembers where the awake bodies are, and how the active bodies will turn.
    void begin(const WorldConfig& config, const WorldState& state, std::span<const Slot> active,
               std::span<const BodyIntegration> integrations, ContactSolver& solver);

    struct Surroundings {
        const WorldConfig& config;
        WorldState& state;
        const Kinematics& kinematics; // bodies are still at their start, with their mean velocities
    };
    /// Corrects the motion of bodies that went through something. Sleeping bodies that are hit move
    /// on at once; woken() lists them, so that they can be woken.
    template <BroadPhase search>
    void solve(const Surroundings& around, std::span<const Slot> active,
               const PairFinder<search>& pairs);
    /// Returns the greatest number of looks at two bodies in a tick. looks() returns the number in
    /// the last solve().
    [[nodiscard]] std::uint64_t looks_max() const { return steps_max_; }
    [[nodiscard]] std::uint64_t looks() const { return steps_max_ - steps_left_; }
    /// True if the last solve() changed a body's velocity or its path.
    [[nodiscard]] bool has_changed_any() const
    {
        const auto flyers = flyers_.all();
        return std::any_of(flyers.begin(), flyers.end(),
                           [](const Flyer& flyer) { return flyer.has_changed; });
    }
    [[nodiscard]] std::span<const BodyId> woken() const { return woken_.all(); }

    /// A body's state before the tick.
    struct Beginning {
        glm::dvec3 position{0.0};
        glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
        glm::dvec3 velocity{0.0};
        glm::dvec3 angular_momentum{0.0};
        DrivenEnergy driven{}; // work of kinematic bodies in touches since then
    };
    /// Returns the state of an awake body at begin(), or of a sleeper that the last solve()
    /// changed.
    [[nodiscard]] const Beginning& beginning(Slot slot) const
    {
        return departures_[slot].beginning;
    }
    /// Calls visit(slot) for the movable bodies whose velocity or path the last solve() changed.
    template <typename Visit>
    void for_changed(const Bodies& bodies, Visit&& visit) const
    {
        for (const Flyer& flyer : flyers_.all()) {
            if (flyer.is_movable && flyer.has_changed) visit(bodies.slot_of[flyer.body]);
        }
    }
    /// Calls visit(slot, slot) for every two movable bodies that pushed each other in solve().
    template <typename Visit>
    void for_pushes(const Bodies& bodies, Visit&& visit) const
    {
        for (const Meeting& meeting : meetings_.all()) {
            if (!meeting.has_pushed || meeting.is_plane) continue;
            const Flyer& a = flyers_[meeting.a];
            const Flyer& b = flyers_[meeting.b];
            if (a.is_movable && b.is_movable) visit(bodies.slot_of[a.body], bodies.slot_of[b.body]);
        }
    }

    /// A fixed or kinematic thing that a movable body ran into.
    struct Wall {
        bool is_kinematic = false;
        bool has_pushed = false;
    };
    /// Calls visit(slot, wall) for each wall that a movable body ran into.
    template <typename Visit>
    void for_walls(const Bodies& bodies, Visit&& visit) const
    {
        for (const Meeting& meeting : meetings_.all()) {
            const Flyer& a = flyers_[meeting.a];
            const Flyer& b = flyers_[meeting.is_plane ? meeting.a : meeting.b];
            if (meeting.is_plane || !b.is_movable)
                visit(bodies.slot_of[a.body],
                      Wall{!meeting.is_plane && b.is_kinematic, meeting.has_pushed});
            else if (!a.is_movable)
                visit(bodies.slot_of[b.body], Wall{a.is_kinematic, meeting.has_pushed});
        }
    }

private:
    using FlyerIndex = std::uint32_t;
    using MeetingIndex = std::uint32_t;
    using ClusterIndex = std::uint32_t;
    static constexpr std::uint32_t none = ~std::uint32_t{0};

    // The number of steps spent at once on two bodies that others may touch first. When half of all
    // steps are used up, two bodies for which `steps_many` do not suffice stick before they touch.
    // Such bodies spin beside each other.
    static constexpr std::uint32_t steps_at_once = 4, steps_many = 32;

    /// A body's state at the start of the tick, and how it turned from there.
    struct Departure {
        enum class Turn : std::uint8_t { free, steady, by_hands };
        Beginning beginning;
        Turn turn = Turn::free;
        glm::dvec3 spin{0.0};         // spin through the tick, if `turn` is steady
        glm::dvec3 acceleration{0.0}; // through the tick; 0 for a sleeper
        BodyMotion start;
        FirstTouch first_touch;
        double least_near = 0.0; // m, see BodyIntegration
    };
    /// A body that goes far, or that such a body may meet.
    struct Flyer {
        BodyId body = 0;
        bool is_movable = false;
        bool is_kinematic = false;
        bool has_parts = false;       // `flight` is then that of a box around all parts
        bool is_fast = false;         // the search looks for others on its path
        bool is_released = false;     // it moves with its velocity at the end of the tick
        bool has_stopped = false;     // it stays where it is for the rest of the tick
        bool has_changed = false;     // it does not end where the solver put it
        FlyerIndex next_stuck = none; // next in a ring of bodies stuck together; `none`: free
        ClusterIndex cluster = none;  // the cluster that it moves with
        bool is_newly_stuck = false;  // stuck, but not yet moving with its cluster
        std::uint32_t touches = 0;
        MeetingIndex first = none;
        double bend = HUGE_VAL; // s: time at which it is released at the latest
        SteadyBox flight;       // time 0 is the start of the tick
        Roll roll;
        Aabb searched{glm::dvec3{1.0}, glm::dvec3{-1.0}}; // region already searched for others
    };
    /// Two things that may touch: a flyer and another flyer or a plane.
    struct Meeting {
        FlyerIndex a = 0;
        std::uint32_t b = 0;
        PartId part_a = 0, part_b = 0; // the parts, if the bodies have several
        bool is_plane = false;
        bool has_pushed = false;
        bool is_over = false;  // the two certainly do not touch again in this tick
        bool is_sure = false;  // the two touch at `time`
        double time = 0.0;     // s: the two certainly do not touch before it
        double gap = 0.0;      // m: gap at which they touch; < 0: an overlap
        double smallest = 0.0; // m: the smallest half edge of the two, or their roundings
        MeetingIndex next_of_a = none;
        MeetingIndex next_of_b = none;
    };
    template <BroadPhase search>
    bool go_to_next_touch(const Surroundings& around, const PairFinder<search>& pairs);
    template <BroadPhase search>
    void go_on(const Surroundings& around, const PairFinder<search>& pairs, FlyerIndex index,
               double time, FlyerIndex done);

    FlyerIndex add_flyer(const Surroundings& around, BodyId body);
    [[nodiscard]] SteadyBox chord(const Bodies& bodies, Slot slot) const;
    [[nodiscard]] bool goes_far(const SteadyBox& flight, double time, double least_near) const;
    [[nodiscard]] double least_near(const Bodies& bodies, Slot slot) const;
    [[nodiscard]] bool got_past(const Bodies& bodies, const Departure& departure) const;
    static void set_part(SteadyBox& flight, const BodyPart& part);
    [[nodiscard]] const SteadyBox& flight_of(const Bodies& bodies, FlyerIndex index, PartId part,
                                             SteadyBox& room) const;
    [[nodiscard]] bool has_to_bend(const Surroundings& around, FlyerIndex index);
    [[nodiscard]] FlyerIndex next_bend(double time) const;
    void bend(const Surroundings& around, FlyerIndex index);
    void release(const Surroundings& around, Flyer& flyer, double time);
    void stop(Flyer& flyer, double time);
    void stop_all(const Surroundings& around, double time);

    template <BroadPhase search>
    void find_others(const Surroundings& around, const PairFinder<search>& pairs, FlyerIndex index,
                     double time);
    [[nodiscard]] bool are_to_meet(FlyerIndex a, std::uint32_t b, bool is_plane) const;
    [[nodiscard]] Gap gap_of(const Surroundings& around, const Meeting& meeting, double time) const;
    void add_meeting(const Surroundings& around, const Meeting& meeting);
    template <typename Visit>
    void for_meetings_of(FlyerIndex index, Visit visit);
    [[nodiscard]] MeetingIndex earliest() const;

    void advance(const Surroundings& around, Meeting& meeting, double from,
                 std::uint32_t looks_max);
    void advance_all(const Surroundings& around, FlyerIndex index, double from, FlyerIndex done);
    [[nodiscard]] bool looks_run_short() const { return steps_left_ <= steps_kept_; }
    [[nodiscard]] bool is_too_much(const Meeting& meeting) const;
    void touch(const Surroundings& around, Meeting& meeting);

    void stick(const Surroundings& around, Meeting& meeting);
    void link(const Surroundings& around, FlyerIndex a, FlyerIndex b);
    void go_together(const Surroundings& around, FlyerIndex index, double time);
    void stick_to_wall(const Surroundings& around, FlyerIndex index, const Meeting& meeting);
    template <typename Visit>
    void for_stuck(FlyerIndex index, Visit visit);
    void note_push(const Bodies& bodies, BodyId body);
    [[nodiscard]] Toucher toucher(const Surroundings& around, const Flyer& flyer,
                                  double time) const;
    struct TouchPoints {
        Manifold manifold;
        double rounding_a = 0.0, rounding_b = 0.0;
    };
    [[nodiscard]] TouchPoints touch_points(const Surroundings& around,
                                           const Meeting& meeting) const;
    bool exchange_impulse(const Surroundings& around, Meeting& meeting);

    Scales scales_;
    Scratch<Departure> departures_; // by slot
    Scratch<Flyer> flyers_;
    Scratch<Meeting> meetings_;
    Scratch<Cluster> clusters_;
    std::vector<FlyerIndex> flyer_of_; // by BodyId; `none` between ticks
    Bounded<BodyId> woken_;
    std::uint32_t steps_max_ = 0; // greatest number of looks at two bodies in a tick
    std::uint32_t steps_left_ = 0;
    std::uint32_t steps_kept_ = 0; // looks kept for bodies that stick together
};

template <typename Visit>
void ContinuousCollision::for_meetings_of(FlyerIndex index, Visit visit)
{
    for (MeetingIndex i = flyers_[index].first; i != none;) {
        Meeting& meeting = meetings_[i];
        i = meeting.a == index ? meeting.next_of_a : meeting.next_of_b;
        visit(meeting);
    }
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/step.hpp"

#include "scene/collide/box_plane.hpp"
#include "scene/collide/nearby.hpp"
#include "scene/rigid/restitution.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

// Contacts that a body has on average, at most: a heap of cubes has about six.
constexpr std::size_t contacts_per_body_max = 8;

// A contact that misses by less than this share of what gravity adds in a tick is in balance.
constexpr double quiet = 1e-10;
// The solver goes on until no contact changes its speed by more than this share of it ...
constexpr double enough = 1e-6;
// ... or this much was done (a stack takes 23 sweeps from nothing); the next tick goes on.
constexpr std::uint32_t sweeps_max = 31, visits_max = 600;

// Overlaps, in shares of the smallest half edge: what is left alone, what the solver goes on
// for, and the most that is moved apart in one tick.
constexpr double overlap_quiet = 1e-9;
constexpr double overlap_enough = 1e-6;
constexpr double overlap_most = 0.02;
constexpr std::uint32_t overlap_visits_max = 200;
// Of an overlap that is there, this share is removed per tick: not all, so that contacts that
// contradict each other settle.
constexpr double overlap_share = 0.3;

// Surfaces that push each other and are not farther apart than this, in smallest half edges, touch.
// What is left of moving overlaps apart is less; chasing it would keep heaps from coming to rest.
constexpr double touching = 2e-6;

/// The least normal speed for which two surfaces so far apart do not overlap at the tick's end.
double closing(double separation, double impulse, const Scales& scales)
{
    const double nothing = impulse > 0.0 ? touching * scales.size : 0.0;
    return separation > nothing ? -separation * scales.rate : 0.0;
}

double parting(double separation, const Scales& scales)
{
    if (separation >= 0.0) return -separation * scales.rate;
    return std::min(overlap_share * -separation, overlap_most * scales.size) * scales.rate;
}

double friction_of(const Material& a, const Material& b)
{
    return std::sqrt(a.friction * b.friction);
}

std::size_t blocks_for(const Frozen& frozen, const Bodies& bodies)
{
    const std::size_t others = bodies.size() - 1 + frozen.planes.size();
    return bodies.movable * std::min(others, contacts_per_body_max);
}

bool any_bounces(const Frozen& frozen, const Bodies& bodies)
{
    const auto bounces = [](const auto& part) { return part.material.restitution > 0.0; };
    return std::any_of(bodies.form.begin(), bodies.form.end(), bounces) ||
           std::any_of(frozen.planes.begin(), frozen.planes.end(), bounces);
}

} // namespace

template <Crowd crowd>
RigidTick<crowd>::RigidTick(const Description& /*description*/, const Frozen& frozen,
                            const Stage& stage)
    : scales_{scales_of(frozen, stage.bodies)},
      bounces_{any_bounces(frozen, stage.bodies)},
      neighbours_{frozen, stage.bodies},
      sleep_{frozen, stage.bodies},
      hands_{frozen},
      boxes_{stage.bodies, scales_},
      fliers_{frozen, stage.bodies},
      engaged_{stage.bodies.movable},
      courses_{stage.bodies.movable + std::size_t{1}},
      solver_{stage.bodies.movable, blocks_for(frozen, stage.bodies)}
{}

template <Crowd crowd>
void RigidTick<crowd>::tick(const Frozen& frozen, Stage& stage)
{
    Bodies& bodies = stage.bodies;
    neighbours_.update(bodies);
    boxes_.begin_tick();
    feel(frozen, stage);
    if constexpr (sleeps) wake(stage);
    look(bodies);
    meet_planes(frozen, stage);
    meet_bodies(stage);
    carry();
    set_out(frozen, stage);
    solve(stage);
    move_apart();
    for (const Slot slot : engaged_.slots()) {
        arrive(courses_[slot + 1], bodies, slot, solver_, scales_);
    }
    engaged_.for_others(bodies.awake, [&](SlotRange range) { fliers_.move(bodies, range); });
    engaged_.clear();
    hands_.report(frozen, stage);
    if constexpr (sleeps) sleep_.rest(bodies, neighbours_, stage.ticks);
}

template <Crowd crowd>
void RigidTick<crowd>::disturbed(Stage& stage, BodyId body)
{
    // What it left and what it meets wakes.
    if constexpr (sleeps) sleep_.wake(body, stage.bodies, neighbours_);
    neighbours_.forget(body);
    hands_.forget(body);
}

/// What the hands touch; they wake it.
template <Crowd crowd>
void RigidTick<crowd>::feel(const Frozen& frozen, Stage& stage)
{
    Bodies& bodies = stage.bodies;
    hands_.begin(frozen, stage);
    for (std::uint32_t hand = 0; hand < frozen.hips.count; ++hand) {
        const HipInput& hip = stage.hips[hand];
        if (hip.present) {
            const glm::dvec3& from = hip.position.value;
            const double radius =
                frozen.hips.radius_m + (hip.gripping ? frozen.hips.grip_reach_m : 0.0);
            for (const BodyId id : neighbours_.reached_by(
                     hand, {from, from + scales_.tick * hip.velocity.value, radius})) {
                const Slot slot = bodies.slot_of[id];
                hands_.touch(frozen, stage, hand,
                             {id, slot < bodies.movable, boxes_.at(bodies, id).box,
                              bodies.velocity.at(slot), bodies.angular_velocity(slot)});
            }
        }
        hands_.end(hand);
    }
    if constexpr (sleeps) {
        for (const HandSprings::Spring& spring : hands_.springs()) {
            sleep_.wake(spring.body, bodies, neighbours_);
        }
    }
}

/// What is pushed, or hit by who is awake, wakes.
template <Crowd crowd>
void RigidTick<crowd>::wake(Stage& stage)
{
    Bodies& bodies = stage.bodies;
    if constexpr (sleeps) {
        for (const BodyId body : stage.pushed) sleep_.wake(body, bodies, neighbours_);
        const auto meet_now = [&](PairIndex index) {
            return between(stage, neighbours_.pair(index)).manifold.count > 0;
        };
        while (sleep_.wake_touched(bodies, neighbours_, meet_now)) {}
    }
}

template <Crowd crowd>
void RigidTick<crowd>::look(const Bodies& bodies)
{
    solver_.begin(bodies.awake);
    courses_.resize(bodies.awake + std::size_t{1});
    courses_[0] = {};
}

/// Begins the tick for an awake body that something acts on.
template <Crowd crowd>
void RigidTick<crowd>::engage(const Bodies& bodies, Slot slot)
{
    if (!engaged_.add(slot)) return;
    const BodyForm& form = bodies.form[slot];
    solver_.response(slot + 1) = response_of(form, boxes_.at(bodies, form.id).box);
    begin(courses_[slot + 1]);
}

template <Crowd crowd>
ContactBlock* RigidTick<crowd>::meet(const Manifold& manifold, const ContactPlaces& centres,
                                     ContactMemory& memory)
{
    if (manifold.count == 0) {
        memory.count = 0;
        return nullptr;
    }
    if (solver_.is_full()) {
        ++counts_.contacts_left_out;
        memory.count = 0;
        return nullptr;
    }
    ContactBlock& block = solver_.add();
    prepare(block, manifold, centres, memory);
    block.memory = &memory;
    for (std::uint32_t i = 0; i < block.count; ++i) {
        block.least[i] = closing(block.separation[i], block.begun[i], scales_);
    }
    return &block;
}

template <Crowd crowd>
void RigidTick<crowd>::meet_planes(const Frozen& frozen, const Stage& stage)
{
    const Bodies& bodies = stage.bodies;
    for (const PairIndex index : neighbours_.plane_pairs()) {
        Pair& pair = neighbours_.plane_pair(index);
        const PlaneDescription& plane = frozen.planes[pair.b];
        const Slot slot = bodies.slot_of[pair.a];
        const BoxNow& now = boxes_.at(bodies, pair.a);
        const OrientedBox& box = now.box;
        const Manifold manifold =
            collide(PlaneSurface{plane.normal, plane.offset_m}, box, now.reach);
        const bool is_carried = touches(pair.memory) || lies_on(manifold, touching * scales_.size);
        ContactBlock* const block = meet(manifold, {box.centre, box.centre}, pair.memory);
        if (block == nullptr) continue;
        engage(bodies, slot);
        const BodyForm& form = bodies.form[slot];
        block->a = 0;
        block->b = slot + 1;
        block->friction = friction_of(form.material, plane.material);
        block->restitution = std::max(form.material.restitution, plane.material.restitution);
        if (form.drag > 0.0 && is_carried) {
            courses_[block->b].drag = form.drag / form.mass;
            courses_[block->b].carrier = plane.normal;
        }
    }
}

template <Crowd crowd>
BoxMeeting RigidTick<crowd>::between(const Stage& stage, Pair& pair)
{
    const Bodies& bodies = stage.bodies;
    const auto box_path = [&](BodyId id) {
        const BoxNow& now = boxes_.at(bodies, id);
        const Slot slot = bodies.slot_of[id];
        return BoxPath{now.box, bodies.velocity.at(slot), slot < bodies.awake ? now.reach : 0.0,
                       now.radius};
    };
    return meeting(box_path(pair.a), box_path(pair.b), scales_.tick, pair.memory.axis);
}

template <Crowd crowd>
void RigidTick<crowd>::meet_bodies(const Stage& stage)
{
    const Bodies& bodies = stage.bodies;
    const auto index_of = [&](Slot slot) -> SolverIndex {
        if (slot >= bodies.awake) return 0;
        engage(bodies, slot);
        return slot + 1;
    };
    for (const PairIndex index : neighbours_.pairs()) {
        Pair& pair = neighbours_.pair(index);
        const Slot a = bodies.slot_of[pair.a];
        const Slot b = bodies.slot_of[pair.b];
        const BoxMeeting meeting = between(stage, pair);
        ContactBlock* const block = meet(meeting.manifold, meeting.centres, pair.memory);
        if (block == nullptr) continue;
        const Material& one = bodies.form[a].material;
        const Material& other = bodies.form[b].material;
        block->a = index_of(a);
        block->b = index_of(b);
        block->friction = friction_of(one, other);
        block->restitution = std::max(one.restitution, other.restitution);
    }
}

/// Sums up what last tick's contacts do to each body.
template <Crowd crowd>
void RigidTick<crowd>::carry()
{
    for (const ContactBlock& block : solver_.blocks()) {
        const Wrench push = wrench(block, modal(block, block.impulse));
        BodyCourse& b = courses_[block.b];
        b.impulse += push.impulse;
        b.angular_impulse += glm::cross(block.arm_b, push.impulse) + push.angular;
        BodyCourse& a = courses_[block.a];
        a.impulse -= push.impulse;
        a.angular_impulse -= glm::cross(block.arm_a, push.impulse) + push.angular;
    }
}

/// Where everyone that something acts on would go.
template <Crowd crowd>
void RigidTick<crowd>::set_out(const Frozen& frozen, const Stage& stage)
{
    for (const BodyId body : stage.pushed) engage(stage.bodies, stage.bodies.slot_of[body]);
    push_by_hands(frozen, stage);
    solver_.ending(0) = {};
    solver_.mean(0) = {};
    for (const Slot slot : engaged_.slots()) {
        BodyCourse& course = courses_[slot + 1];
        if (!course.has_hands) follow(course, stage, slot, solver_.response(slot + 1), frozen);
        if (bounces_) course.rebound = course.start;
    }
    if (bounces_) bounce(solver_, courses_.all(), scales_);
    for (const Slot slot : engaged_.slots()) {
        solver_.ending(slot + 1) = courses_[slot + 1].tentative;
    }
    for (ContactBlock& block : solver_.blocks()) {
        set_bend(block, courses_[block.a].start.spin, courses_[block.b].start.spin, scales_.tick);
    }
}

template <Crowd crowd>
void RigidTick<crowd>::push_by_hands(const Frozen& frozen, const Stage& stage)
{
    for (const HandSprings::Spring& spring : hands_.springs()) {
        const Slot slot = stage.bodies.slot_of[spring.body];
        engage(stage.bodies, slot);
        BodyCourse& course = courses_[slot + 1];
        if (course.has_hands) continue;
        const auto [springs, work] = hands_.on(spring.body);
        follow_hands(course, stage, slot, solver_.response(slot + 1), {springs, work, frozen});
        hands_.worked(spring.body);
    }
}

/// Finds the velocities at the end, and from them the mean ones.
template <Crowd crowd>
void RigidTick<crowd>::solve(const Stage& stage)
{
    const Bodies& bodies = stage.bodies;
    const std::span<ContactBlock> blocks = solver_.blocks();
    const SolverOutcome outcome =
        solver_.solve({quiet * scales_.speed, enough * scales_.speed, sweeps_max, visits_max});
    counts_.contacts = static_cast<std::uint32_t>(blocks.size());
    counts_.sweeps = outcome.sweeps;
    counts_.change = outcome.change;
    for (const Slot slot : engaged_.slots()) {
        const BodyCourse& course = courses_[slot + 1];
        const BodyMotion& ending = solver_.ending(slot + 1);
        solver_.mean(slot + 1) = {course.mean.velocity +
                                      0.5 * (ending.velocity - course.tentative.velocity),
                                  course.mean.spin + 0.5 * (ending.spin - course.tentative.spin),
                                  course.thrown_mean + 0.5 * ending.angular_impulse};
    }
    const auto weight_of = [&](const ContactBlock& block) {
        const double a = block.a != 0 ? bodies.form[block.a - 1].mass : 0.0;
        const double b = block.b != 0 ? bodies.form[block.b - 1].mass : 0.0;
        return (a + b) * scales_.speed;
    };
    for (const ContactBlock& block : blocks) {
        remember(block, weight_of(block), *block.memory);
        if (block.friction == 0.0 || !(block.normal_sum() > 0.0)) continue;
        ++courses_[block.a].rubbing;
        ++courses_[block.b].rubbing;
    }
    for (const ContactBlock& block : blocks) {
        if (block.friction == 0.0 || (block.a != 0) == (block.b != 0)) continue;
        const SolverIndex index = block.a + block.b;
        if (courses_[index].rubbing != 1) continue;
        stop_in_time(block, courses_[index], bodies.form[index - 1], scales_, solver_.mean(index));
    }
}

/// Changes the ways so that nothing overlaps at the end, without a change of velocities.
template <Crowd crowd>
void RigidTick<crowd>::move_apart()
{
    for (ContactBlock& block : solver_.blocks()) {
        for (std::uint32_t i = 0; i < block.count; ++i) {
            block.least[i] = parting(block.separation[i], scales_);
        }
        for (double& part : block.bend) part *= 0.5; // of the mean over the tick
    }
    const double length = scales_.size * scales_.rate;
    const SolverLimits limits{overlap_quiet * length, overlap_enough * length, sweeps_max,
                              overlap_visits_max};
    solver_.separate(limits);
    // Who is thrown out of his way is held back, and the others go as far as that lets them.
    const auto keep = [&] {
        return keep_to_paths(engaged_.slots(), courses_.all(), solver_, scales_);
    };
    if (!keep()) return;
    solver_.separate_again(limits);
    keep();
}

template class RigidTick<Crowd::lone>;
template class RigidTick<Crowd::few>;
template class RigidTick<Crowd::many>;

} // namespace hapnet::scene

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

std::size_t blocks_for(const WorldConfig& config, const Bodies& bodies)
{
    const std::size_t others = bodies.size() - 1 + config.planes.size();
    return bodies.movable * std::min(others, contacts_per_body_max);
}

bool any_bounces(const WorldConfig& config, const Bodies& bodies)
{
    const auto bounces = [](const auto& part) { return part.material.restitution > 0.0; };
    return std::any_of(bodies.properties.begin(), bodies.properties.end(), bounces) ||
           std::any_of(config.planes.begin(), config.planes.end(), bounces);
}

} // namespace

template <BroadPhase broad_phase>
RigidStepper<broad_phase>::RigidStepper(const Description& /*description*/,
                                        const WorldConfig& config, const WorldState& state)
    : scales_{scales_of(config, state.bodies)},
      bounces_{any_bounces(config, state.bodies)},
      neighbours_{config, state.bodies},
      sleep_{config, state.bodies},
      hands_{config},
      boxes_{state.bodies, scales_},
      free_bodies_{config, state.bodies},
      active_{state.bodies.movable},
      courses_{state.bodies.movable + std::size_t{1}},
      solver_{state.bodies.movable, blocks_for(config, state.bodies)}
{}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::step(const WorldConfig& config, WorldState& state)
{
    Bodies& bodies = state.bodies;
    neighbours_.update(bodies);
    boxes_.begin_tick();
    feel(config, state);
    if constexpr (sleeps) wake(state);
    look(bodies);
    meet_planes(config, state);
    meet_bodies(state);
    carry();
    set_out(config, state);
    solve(state);
    move_apart();
    for (const Slot slot : active_.slots()) {
        arrive(courses_[slot + 1], bodies, slot, solver_, scales_);
    }
    active_.for_inactive(bodies.awake,
                         [&](SlotRange range) { free_bodies_.integrate(bodies, range); });
    active_.clear();
    hands_.report(config, state);
    if constexpr (sleeps) sleep_.rest(bodies, neighbours_, state.ticks);
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::on_body_placed(WorldState& state, BodyId body)
{
    // What it left and what it meets wakes.
    if constexpr (sleeps) sleep_.wake(body, state.bodies, neighbours_);
    neighbours_.forget(body);
    hands_.forget(body);
}

/// What the hands touch; they wake it.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::feel(const WorldConfig& config, WorldState& state)
{
    Bodies& bodies = state.bodies;
    hands_.begin(config, state);
    for (std::uint32_t hand = 0; hand < config.hands.count; ++hand) {
        const HandInput& input = state.hands[hand];
        if (input.present) {
            const glm::dvec3& from = input.position.value;
            const double radius =
                config.hands.radius_m + (input.gripping ? config.hands.grip_reach_m : 0.0);
            for (const BodyId id : neighbours_.reached_by(
                     hand, {from, from + scales_.tick * input.velocity.value, radius})) {
                const Slot slot = bodies.slot_of[id];
                hands_.touch(config, state, hand,
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
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::wake(WorldState& state)
{
    Bodies& bodies = state.bodies;
    if constexpr (sleeps) {
        for (const BodyId body : state.pushed) sleep_.wake(body, bodies, neighbours_);
        const auto meet_now = [&](PairIndex index) {
            return between(state, neighbours_.pair(index)).manifold.count > 0;
        };
        while (sleep_.wake_touched(bodies, neighbours_, meet_now)) {}
    }
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::look(const Bodies& bodies)
{
    solver_.begin(bodies.awake);
    courses_.resize(bodies.awake + std::size_t{1});
    courses_[0] = {};
}

/// Begins the tick for an awake body that something acts on.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::engage(const Bodies& bodies, Slot slot)
{
    if (!active_.add(slot)) return;
    const BodyProperties& properties = bodies.properties[slot];
    solver_.response(slot + 1) = response_of(properties, boxes_.at(bodies, properties.id).box);
    begin(courses_[slot + 1]);
}

template <BroadPhase broad_phase>
ContactBlock* RigidStepper<broad_phase>::meet(const Manifold& manifold,
                                              const ContactPlaces& centres, ContactMemory& memory)
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

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::meet_planes(const WorldConfig& config, const WorldState& state)
{
    const Bodies& bodies = state.bodies;
    for (const PairIndex index : neighbours_.plane_pairs()) {
        Pair& pair = neighbours_.plane_pair(index);
        const PlaneDescription& plane = config.planes[pair.b];
        const Slot slot = bodies.slot_of[pair.a];
        const BoxNow& now = boxes_.at(bodies, pair.a);
        const OrientedBox& box = now.box;
        const Manifold manifold =
            collide(PlaneSurface{plane.normal, plane.offset_m}, box, now.reach);
        const bool is_carried = touches(pair.memory) || lies_on(manifold, touching * scales_.size);
        ContactBlock* const block = meet(manifold, {box.centre, box.centre}, pair.memory);
        if (block == nullptr) continue;
        engage(bodies, slot);
        const BodyProperties& properties = bodies.properties[slot];
        block->a = 0;
        block->b = slot + 1;
        block->friction = friction_of(properties.material, plane.material);
        block->restitution = std::max(properties.material.restitution, plane.material.restitution);
        if (properties.drag > 0.0 && is_carried) {
            courses_[block->b].drag = properties.drag / properties.mass;
            courses_[block->b].carrier = plane.normal;
        }
    }
}

template <BroadPhase broad_phase>
BoxMeeting RigidStepper<broad_phase>::between(const WorldState& state, Pair& pair)
{
    const Bodies& bodies = state.bodies;
    const auto box_path = [&](BodyId id) {
        const BoxNow& now = boxes_.at(bodies, id);
        const Slot slot = bodies.slot_of[id];
        return BoxPath{now.box, bodies.velocity.at(slot), slot < bodies.awake ? now.reach : 0.0,
                       now.radius};
    };
    return meeting(box_path(pair.a), box_path(pair.b), scales_.tick, pair.memory.axis);
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::meet_bodies(const WorldState& state)
{
    const Bodies& bodies = state.bodies;
    const auto index_of = [&](Slot slot) -> SolverIndex {
        if (slot >= bodies.awake) return 0;
        engage(bodies, slot);
        return slot + 1;
    };
    for (const PairIndex index : neighbours_.pairs()) {
        Pair& pair = neighbours_.pair(index);
        const Slot a = bodies.slot_of[pair.a];
        const Slot b = bodies.slot_of[pair.b];
        const BoxMeeting meeting = between(state, pair);
        ContactBlock* const block = meet(meeting.manifold, meeting.centres, pair.memory);
        if (block == nullptr) continue;
        const Material& one = bodies.properties[a].material;
        const Material& other = bodies.properties[b].material;
        block->a = index_of(a);
        block->b = index_of(b);
        block->friction = friction_of(one, other);
        block->restitution = std::max(one.restitution, other.restitution);
    }
}

/// Sums up what last tick's contacts do to each body.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::carry()
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
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::set_out(const WorldConfig& config, const WorldState& state)
{
    for (const BodyId body : state.pushed) engage(state.bodies, state.bodies.slot_of[body]);
    push_by_hands(config, state);
    solver_.ending(0) = {};
    solver_.mean(0) = {};
    for (const Slot slot : active_.slots()) {
        BodyCourse& course = courses_[slot + 1];
        if (!course.has_hands) follow(course, state, slot, solver_.response(slot + 1), config);
        if (bounces_) course.rebound = course.start;
    }
    if (bounces_) bounce(solver_, courses_.all(), scales_);
    for (const Slot slot : active_.slots()) {
        solver_.ending(slot + 1) = courses_[slot + 1].tentative;
    }
    for (ContactBlock& block : solver_.blocks()) {
        set_bend(block, courses_[block.a].start.spin, courses_[block.b].start.spin, scales_.tick);
    }
}

template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::push_by_hands(const WorldConfig& config, const WorldState& state)
{
    for (const HandSprings::Spring& spring : hands_.springs()) {
        const Slot slot = state.bodies.slot_of[spring.body];
        engage(state.bodies, slot);
        BodyCourse& course = courses_[slot + 1];
        if (course.has_hands) continue;
        const auto [springs, work] = hands_.on(spring.body);
        follow_hands(course, state, slot, solver_.response(slot + 1), {springs, work, config});
        hands_.worked(spring.body);
    }
}

/// Finds the velocities at the end, and from them the mean ones.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::solve(const WorldState& state)
{
    const Bodies& bodies = state.bodies;
    const std::span<ContactBlock> blocks = solver_.blocks();
    const SolverOutcome outcome =
        solver_.solve({quiet * scales_.speed, enough * scales_.speed, sweeps_max, visits_max});
    counts_.contacts = static_cast<std::uint32_t>(blocks.size());
    counts_.sweeps = outcome.sweeps;
    counts_.change = outcome.change;
    for (const Slot slot : active_.slots()) {
        const BodyCourse& course = courses_[slot + 1];
        const BodyMotion& ending = solver_.ending(slot + 1);
        solver_.mean(slot + 1) = {course.mean.velocity +
                                      0.5 * (ending.velocity - course.tentative.velocity),
                                  course.mean.spin + 0.5 * (ending.spin - course.tentative.spin),
                                  course.thrown_mean + 0.5 * ending.angular_impulse};
    }
    const auto weight_of = [&](const ContactBlock& block) {
        const double a = block.a != 0 ? bodies.properties[block.a - 1].mass : 0.0;
        const double b = block.b != 0 ? bodies.properties[block.b - 1].mass : 0.0;
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
        stop_in_time(block, courses_[index], bodies.properties[index - 1], scales_,
                     solver_.mean(index));
    }
}

/// Changes the ways so that nothing overlaps at the end, without a change of velocities.
template <BroadPhase broad_phase>
void RigidStepper<broad_phase>::move_apart()
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
        return keep_to_paths(active_.slots(), courses_.all(), solver_, scales_);
    };
    if (!keep()) return;
    solver_.separate_again(limits);
    keep();
}

template class RigidStepper<BroadPhase::none>;
template class RigidStepper<BroadPhase::all_pairs>;
template class RigidStepper<BroadPhase::grid>;

} // namespace hapnet::scene

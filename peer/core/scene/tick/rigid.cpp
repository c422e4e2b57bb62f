// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/tick/rigid.hpp"

#include "peer/core/scene/contact/box_plane.hpp"

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
constexpr double enough = 1e-7;
// ... or this many sweeps were made. Measured: see the table in docs/BENCHMARKS.md.
constexpr std::uint32_t sweeps_max = 60;

// Overlaps, in shares of the smallest half edge: what is left alone, what the solver goes on
// for, and the most that is moved apart in one tick.
constexpr double overlap_quiet = 1e-9;
constexpr double overlap_enough = 1e-6;
constexpr double overlap_most = 0.02;
constexpr std::uint32_t overlap_sweeps_max = 12;
// Of an overlap that is there, this share is removed per tick: not all, so that contacts that
// contradict each other settle.
constexpr double overlap_share = 0.3;

// What comes nearer than this share of the smallest half edge within a tick is looked at.
constexpr double look_ahead = 0.01;

/// The least normal speed for which two surfaces so far apart do not overlap at the tick's end.
double closing(double separation, double tick)
{
    return separation > 0.0 ? -separation / tick : 0.0;
}

double parting(double separation, const Scales& scales)
{
    if (separation >= 0.0) return -separation / scales.tick;
    return std::min(overlap_share * -separation, overlap_most * scales.size) / scales.tick;
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

} // namespace

template <Crowd crowd>
RigidTick<crowd>::RigidTick(const Description& /*description*/, const Frozen& frozen,
                            const Stage& stage)
    : scales_{scales_of(frozen, stage.bodies)},
      neighbours_{frozen, stage.bodies},
      boxes_(stage.bodies.size()),
      courses_{stage.bodies.movable + std::size_t{1}},
      solver_{stage.bodies.movable, blocks_for(frozen, stage.bodies)}
{
    const Bodies& bodies = stage.bodies;
    for (Slot slot = 0; slot < bodies.size(); ++slot) {
        boxes_[bodies.form[slot].id] = box_of(bodies, slot);
    }
}

template <Crowd crowd>
SolverIndex RigidTick<crowd>::index_of(const Stage& stage, Slot slot) const
{
    return slot < stage.bodies.awake ? slot + 1 : 0;
}

/// How far any part of the body may come in the tick.
template <Crowd crowd>
double RigidTick<crowd>::reach(const Stage& stage, Slot slot) const
{
    const Bodies& bodies = stage.bodies;
    if (slot >= bodies.awake) return 0.0;
    const glm::dvec3& half = bodies.form[slot].half;
    const glm::dvec3 v = bodies.velocity.at(slot);
    const glm::dvec3 w = bodies.angular_velocity(slot);
    const double speed = std::sqrt(glm::dot(v, v));
    const double turning = std::sqrt(glm::dot(w, w) * glm::dot(half, half));
    return scales_.tick * (speed + turning + scales_.fall) +
           look_ahead * std::min(half.x, std::min(half.y, half.z));
}

/// Begins the tick: where everyone is and how he answers.
template <Crowd crowd>
void RigidTick<crowd>::look(const Frozen& /*frozen*/, const Stage& stage)
{
    const Bodies& bodies = stage.bodies;
    solver_.begin(bodies.awake);
    courses_.resize(bodies.awake + std::size_t{1});
    for (Slot slot = 0; slot < bodies.awake; ++slot) {
        const BodyForm& form = bodies.form[slot];
        OrientedBox& box = boxes_[form.id];
        box = box_of(bodies, slot);
        solver_.response(slot + 1) = response_of(form, box);
        BodyCourse& course = courses_[slot + 1];
        course.impulse = glm::dvec3{0.0};
        course.angular_impulse = glm::dvec3{0.0};
        course.rubbing = 0;
    }
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
        block.least[i] = closing(block.separation[i], scales_.tick);
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
        const OrientedBox& box = boxes_[pair.a];
        const Manifold manifold =
            collide(PlaneSurface{plane.normal, plane.offset_m}, box, reach(stage, slot));
        ContactBlock* const block = meet(manifold, {box.centre, box.centre}, pair.memory);
        if (block == nullptr) continue;
        const Material& material = bodies.form[slot].material;
        block->a = 0;
        block->b = slot + 1;
        block->friction = friction_of(material, plane.material);
        block->restitution = std::max(material.restitution, plane.material.restitution);
    }
}

template <Crowd crowd>
void RigidTick<crowd>::meet_bodies(const Frozen& /*frozen*/, const Stage& stage)
{
    const Bodies& bodies = stage.bodies;
    for (const PairIndex index : neighbours_.pairs()) {
        Pair& pair = neighbours_.pair(index);
        const Slot a = bodies.slot_of[pair.a];
        const Slot b = bodies.slot_of[pair.b];
        const OrientedBox& box_a = boxes_[pair.a];
        const OrientedBox& box_b = boxes_[pair.b];
        const Manifold manifold =
            collide(box_a, box_b, reach(stage, a) + reach(stage, b), pair.memory.axis);
        ContactBlock* const block = meet(manifold, {box_a.centre, box_b.centre}, pair.memory);
        if (block == nullptr) continue;
        const Material& one = bodies.form[a].material;
        const Material& other = bodies.form[b].material;
        block->a = index_of(stage, a);
        block->b = index_of(stage, b);
        block->friction = friction_of(one, other);
        block->restitution = std::max(one.restitution, other.restitution);
    }
}

template <Crowd crowd>
void RigidTick<crowd>::tick(const Frozen& frozen, Stage& stage)
{
    Bodies& bodies = stage.bodies;
    neighbours_.update(bodies);
    look(frozen, stage);
    meet_planes(frozen, stage);
    meet_bodies(frozen, stage);
    const std::span<ContactBlock> blocks = solver_.blocks();
    for (ContactBlock& block : blocks) {
        Wrench push = wrench(block, modal(block, block.impulse));
        if (block.b != 0) {
            courses_[block.b].impulse += push.impulse;
            courses_[block.b].angular_impulse +=
                glm::cross(block.arm_b, push.impulse) + push.angular;
        }
        if (block.a != 0) {
            courses_[block.a].impulse -= push.impulse;
            courses_[block.a].angular_impulse -=
                glm::cross(block.arm_a, push.impulse) + push.angular;
        }
    }
    solver_.ending(0) = {};
    solver_.mean(0) = {};
    for (Slot slot = 0; slot < bodies.awake; ++slot) {
        BodyCourse& course = courses_[slot + 1];
        follow(course, stage, slot, solver_.response(slot + 1), frozen);
        solver_.ending(slot + 1) = course.tentative;
    }
    const SolverOutcome outcome =
        solver_.solve({quiet * scales_.speed, enough * scales_.speed, sweeps_max});
    counts_.contacts = static_cast<std::uint32_t>(blocks.size());
    counts_.sweeps = outcome.sweeps;
    counts_.change = outcome.change;
    for (Slot slot = 0; slot < bodies.awake; ++slot) {
        const BodyCourse& course = courses_[slot + 1];
        const BodyMotion& ending = solver_.ending(slot + 1);
        BodyMotion& mean = solver_.mean(slot + 1);
        mean.velocity = course.mean.velocity + 0.5 * (ending.velocity - course.tentative.velocity);
        mean.spin = course.mean.spin + 0.5 * (ending.spin - course.tentative.spin);
        mean.angular_impulse = 0.5 * ending.angular_impulse;
    }
    for (ContactBlock& block : blocks) {
        remember(block, *block.memory);
        if (block.friction > 0.0 && block.normal_sum() > 0.0) {
            ++courses_[block.a].rubbing;
            ++courses_[block.b].rubbing;
        }
    }
    for (const ContactBlock& block : blocks) {
        if (!(block.friction > 0.0) || (block.a != 0) == (block.b != 0)) continue;
        const SolverIndex index = block.a + block.b;
        if (courses_[index].rubbing != 1) continue;
        stop_in_time(block, courses_[index], bodies.form[index - 1], scales_, solver_.mean(index));
    }
    for (ContactBlock& block : blocks) {
        for (std::uint32_t i = 0; i < block.count; ++i) {
            block.least[i] = parting(block.separation[i], scales_);
        }
    }
    const double length = scales_.size / scales_.tick;
    solver_.separate({overlap_quiet * length, overlap_enough * length, overlap_sweeps_max});
    for (Slot slot = 0; slot < bodies.awake; ++slot) {
        arrive(courses_[slot + 1], bodies, slot, solver_, scales_.tick);
    }
}

template <Crowd crowd>
void RigidTick<crowd>::disturbed(Stage& stage, BodyId body)
{
    neighbours_.forget(body);
    boxes_[body] = box_of(stage.bodies, stage.bodies.slot_of[body]);
}

template class RigidTick<Crowd::lone>;
template class RigidTick<Crowd::few>;
template class RigidTick<Crowd::many>;

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/tick/sliding/hands.hpp"

#include <cmath>

namespace hapnet::scene {

namespace {

double dot(const glm::dvec3& a, const glm::dvec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

double largest(const glm::dvec3& v) { return std::max(std::max(v.x, v.y), v.z); }

double distance(const glm::dvec3& from_centre, const glm::dvec3& half)
{
    const glm::dvec3 out = glm::max(glm::abs(from_centre) - half, glm::dvec3{0.0});
    return std::sqrt(dot(out, out));
}

/// The spring and damper alone, at one moment.
double force_at(const HipDescription& hips, double depth, double closing)
{
    if (depth <= 0.0) return 0.0;
    return std::clamp(hips.stiffness_n_per_m * depth + hips.damping_ns_per_m * closing, 0.0,
                      hips.force_max_n);
}

} // namespace

SlidingHands::SlidingHands(const Frozen& frozen, const Bodies& bodies, const BodyForm& movable)
    : body_{movable.id},
      half_{movable.half},
      margin_{std::min(std::min(movable.half.x, movable.half.y), movable.half.z)}
{
    for (const Slot slot : bodies.slot_of) {
        if (bodies.form[slot].mass > 0.0) continue;
        fixed_.push_back({bodies.position.at(slot), bodies.form[slot].half});
    }
    entered_fixed_.resize(frozen.hips.count * fixed_.size());
}

void SlidingHands::gather(const Frozen& frozen, Stage& stage, Slide& slide)
{
    for (std::uint32_t i = 0; i < frozen.hips.count; ++i) {
        const HipInput& hip = stage.hips[i];
        stage.touches[i] = HipTouch{.body = body_};
        Memory& memory = memory_[i];
        if (!hip.present) {
            memory.entered = {};
            memory.held_at.reset();
            continue;
        }
        if (!fixed_.empty()) touch_fixed(frozen, stage, i);
        if (!hip.gripping) {
            memory.held_at.reset();
        } else if (!memory.held_at) {
            const glm::dvec3 from_centre = hip.position.value - slide.place;
            const double reach = frozen.hips.radius_m + frozen.hips.grip_reach_m;
            if (distance(from_centre, half_) <= reach) memory.held_at = from_centre;
        }
        if (memory.held_at) {
            hold(frozen, stage, slide, i);
        } else {
            touch_box(frozen, stage, slide, i);
        }
    }
}

void SlidingHands::hold(const Frozen& frozen, Stage& stage, Slide& slide, std::uint32_t index)
{
    const HipDescription& hips = frozen.hips;
    const HipInput& hip = stage.hips[index];
    Memory& memory = memory_[index];
    memory.entered = {};
    const Grip grip{index, hip.position.value - (slide.place + *memory.held_at), hip.velocity.value,
                    glm::dvec3{0.0}};
    const base::Force wanted{hips.stiffness_n_per_m * grip.stretch +
                             hips.damping_ns_per_m * (grip.velocity - slide.velocity)};
    const base::Force force = base::limited(wanted, hips.force_max_n);
    const double out = distance(hip.position.value - slide.place, half_);
    HipTouch& touch = stage.touches[index];
    touch.holding = true;
    touch.depth_m = std::max(touch.depth_m, std::max(hips.radius_m - out, 0.0));
    touch.on_hip_at_start += -force;
    if (force == wanted) {
        slide.grips[slide.grip_count++] = grip;
        return;
    }
    touch.on_body = force; // held for the tick
    for (const int i : {0, 1, 2}) slide.axis(i).steady += slide.inverse_mass * force.value[i];
}

void SlidingHands::touch_box(const Frozen& frozen, Stage& stage, Slide& slide, std::uint32_t index)
{
    const HipDescription& hips = frozen.hips;
    const HipInput& hip = stage.hips[index];
    const Approach approach{.from_centre = hip.position.value - slide.place,
                            .velocity = hip.velocity.value - slide.velocity,
                            .radius = hips.radius_m,
                            .tick = frozen.tick};
    const glm::dvec3 apart =
        glm::abs(approach.from_centre) - half_ - 2.0 * frozen.tick * glm::abs(approach.velocity);
    if (largest(apart) > hips.radius_m + margin_) {
        memory_[index].entered = {};
        return;
    }
    const auto meeting = meet(approach, half_, memory_[index].entered);
    if (!meeting) return;
    HipTouch& touch = stage.touches[index];
    touch.depth_m = std::max(touch.depth_m, meeting->depth);
    double force = 0.0;
    if (meeting->axis >= 0) {
        const int axis = meeting->axis;
        Spring& spring = slide.springs[slide.spring_count++];
        spring.hip = index;
        spring.axis = axis;
        spring.sign = meeting->normal[axis];
        spring.depth = meeting->depth;
        spring.closing = -spring.sign * hip.velocity.value[axis];
        spring.phase = spring.phase_now(hips, slide.velocity[axis]);
        spring.impulse = 0.0;
        force = spring.force(hips, slide.velocity[axis]);
    } else {
        const double closing = -dot(meeting->normal, hip.velocity.value);
        slide.slanted[slide.slanted_count++] = {index, meeting->normal, meeting->depth, closing,
                                                0.0};
        force = force_at(hips, meeting->depth, -dot(meeting->normal, approach.velocity));
    }
    touch.on_hip_at_start.value += force * meeting->normal;
}

void SlidingHands::touch_fixed(const Frozen& frozen, Stage& stage, std::uint32_t index)
{
    const HipDescription& hips = frozen.hips;
    const HipInput& hip = stage.hips[index];
    HipTouch& touch = stage.touches[index];
    Memory& memory = memory_[index];
    const glm::dvec3 gone = glm::abs(hip.position.value - memory.seen_from);
    const double sweep = frozen.tick * largest(glm::abs(hip.velocity.value)) + hips.radius_m;
    if (largest(gone) + sweep < memory.clear) return;
    memory.seen_from = hip.position.value;
    memory.clear = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < fixed_.size(); ++i) {
        const Approach approach{.from_centre = hip.position.value - fixed_[i].centre,
                                .velocity = hip.velocity.value,
                                .radius = hips.radius_m,
                                .tick = frozen.tick};
        EnteredFace& entered = entered_fixed_[index * fixed_.size() + i];
        const double apart = largest(glm::abs(approach.from_centre) - fixed_[i].half);
        memory.clear = std::min(memory.clear, apart);
        if (apart >= sweep) {
            entered = {};
            continue;
        }
        const auto meeting = meet(approach, fixed_[i].half, entered);
        if (!meeting) continue;
        const double closing = -dot(meeting->normal, hip.velocity.value);
        const double mean =
            steady_impulse(hips, meeting->depth, closing, frozen.tick) / frozen.tick;
        touch.depth_m = std::max(touch.depth_m, meeting->depth);
        touch.on_hip.value += mean * meeting->normal;
        touch.on_hip_at_start.value += force_at(hips, meeting->depth, closing) * meeting->normal;
    }
}

void SlidingHands::press_slanted(Slide& slide)
{
    const HipDescription& hips = slide.hips;
    const double half_tick = 0.5 * slide.left;
    for (SlantedSpring& spring : slide.active_slanted()) {
        const glm::dvec3& normal = spring.normal;
        double closing = spring.closing;
        double bend = 0.0; // of the depth, without this spring
        double ease = 0.0; // 1/mass along the normal
        for (const int i : {0, 1, 2}) {
            if (!slide.course(i).moves()) continue;
            closing += normal[i] * slide.velocity[i];
            bend += normal[i] * slide.axis(i).acceleration;
            ease += normal[i] * normal[i] * slide.inverse_mass;
        }
        // depth and closing speed in the middle: linear in the force that acts meanwhile.
        const double answer =
            hips.stiffness_n_per_m * half_tick * half_tick + hips.damping_ns_per_m * half_tick;
        const double depth = spring.depth + half_tick * closing;
        const double free_force =
            hips.stiffness_n_per_m * depth + hips.damping_ns_per_m * closing + answer * bend;
        spring.force = std::clamp(free_force / (1.0 + answer * ease), 0.0, hips.force_max_n);
        if (depth + half_tick * half_tick * (bend - ease * spring.force) <= 0.0) spring.force = 0.0;
        for (const int i : {0, 1, 2}) {
            const double change = -slide.inverse_mass * spring.force * normal[i];
            slide.axis(i).steady += change;
            if (slide.course(i).moves()) slide.axis(i).acceleration += change;
        }
    }
}

void SlidingHands::report(const Frozen& frozen, Stage& stage, const Slide& slide)
{
    for (const Spring& spring : slide.active_springs()) {
        stage.touches[spring.hip].on_body.value[spring.axis] -=
            spring.sign * std::max(spring.impulse / frozen.tick, 0.0);
    }
    for (const SlantedSpring& spring : slide.active_slanted()) {
        stage.touches[spring.hip].on_body.value -= spring.force * spring.normal;
    }
    for (const Grip& grip : slide.active_grips()) {
        stage.touches[grip.hip].on_body.value += grip.impulse / frozen.tick;
    }
    for (std::uint32_t i = 0; i < frozen.hips.count; ++i) {
        HipTouch& touch = stage.touches[i];
        touch.touching = touch.holding || touch.on_body != base::Force{};
        touch.on_hip += -touch.on_body;
    }
}

void SlidingHands::forget_box()
{
    for (Memory& memory : memory_) {
        memory.entered = {};
        memory.held_at.reset();
    }
}

} // namespace hapnet::scene

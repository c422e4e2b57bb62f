// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/tick/sliding/hands.hpp"

#include <cmath>

namespace hapnet::scene {

namespace {

double largest(const PerAxis& a) { return std::max(std::max(a[0], a[1]), a[2]); }

/// How far a place is outside of a box along each axis; < 0: inside.
PerAxis beyond(const PerAxis& from_centre, const PerAxis& half)
{
    return {std::abs(from_centre[0]) - half[0], std::abs(from_centre[1]) - half[1],
            std::abs(from_centre[2]) - half[2]};
}

double distance(const PerAxis& from_centre, const PerAxis& half)
{
    PerAxis out = beyond(from_centre, half);
    for (double& part : out) part = std::max(part, 0.0);
    return std::sqrt(dot(out, out));
}

PerAxis difference(const glm::dvec3& a, const PerAxis& b)
{
    return {a.x - b[0], a.y - b[1], a.z - b[2]};
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
      half_{per_axis(movable.half)},
      margin_{std::min(std::min(movable.half.x, movable.half.y), movable.half.z)}
{
    for (const Slot slot : bodies.slot_of) {
        if (bodies.form[slot].mass > 0.0) continue;
        fixed_.push_back({per_axis(bodies.position.at(slot)), per_axis(bodies.form[slot].half)});
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
            const PerAxis from_centre = difference(hip.position.value, slide.place);
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
    const PerAxis from_centre = difference(hip.position.value, slide.place);
    Grip grip{index, from_centre, per_axis(hip.velocity.value), {}};
    base::Force wanted;
    for (std::size_t i = 0; i < 3; ++i) {
        grip.stretch[i] -= (*memory.held_at)[i];
        wanted.value[static_cast<int>(i)] =
            hips.stiffness_n_per_m * grip.stretch[i] +
            hips.damping_ns_per_m * (grip.velocity[i] - slide.velocity[i]);
    }
    const base::Force force = base::limited(wanted, hips.force_max_n);
    HipTouch& touch = stage.touches[index];
    touch.holding = true;
    touch.depth_m =
        std::max(touch.depth_m, std::max(hips.radius_m - distance(from_centre, half_), 0.0));
    touch.on_hip_at_start += -force;
    if (force == wanted) {
        slide.grips[slide.grip_count++] = grip;
        return;
    }
    touch.on_body = force; // held for the tick
    const PerAxis held = per_axis(force.value);
    for (std::size_t i = 0; i < 3; ++i) slide.axes[i].steady += slide.inverse_mass * held[i];
}

void SlidingHands::touch_box(const Frozen& frozen, Stage& stage, Slide& slide, std::uint32_t index)
{
    const HipDescription& hips = frozen.hips;
    const HipInput& hip = stage.hips[index];
    const Approach approach{.from_centre = difference(hip.position.value, slide.place),
                            .velocity = difference(hip.velocity.value, slide.velocity),
                            .radius = hips.radius_m,
                            .tick = frozen.tick};
    const double far = hips.radius_m + margin_;
    for (std::size_t i = 0; i < 3; ++i) {
        const double swept = 2.0 * frozen.tick * std::abs(approach.velocity[i]);
        if (std::abs(approach.from_centre[i]) > half_[i] + far + swept) {
            memory_[index].entered = {};
            return;
        }
    }
    const auto meeting = meet(approach, half_, memory_[index].entered);
    if (!meeting) return;
    HipTouch& touch = stage.touches[index];
    touch.depth_m = std::max(touch.depth_m, meeting->depth);
    double force = 0.0;
    if (meeting->axis != no_axis) {
        const std::size_t axis = meeting->axis;
        Spring& spring = slide.springs[slide.spring_count++];
        spring.hip = index;
        spring.axis = axis;
        spring.sign = meeting->normal[axis];
        spring.depth = meeting->depth;
        spring.closing = -spring.sign * (approach.velocity[axis] + slide.velocity[axis]);
        spring.phase = spring.phase_now(hips, slide.velocity[axis]);
        spring.impulse = 0.0;
        force = spring.force(hips, slide.velocity[axis]);
    } else {
        const double closing = -dot(meeting->normal, per_axis(hip.velocity.value));
        slide.slanted[slide.slanted_count++] = {index, meeting->normal, meeting->depth, closing,
                                                0.0};
        force = force_at(hips, meeting->depth, -dot(meeting->normal, approach.velocity));
    }
    touch.on_hip_at_start.value += force * vector(meeting->normal);
}

void SlidingHands::touch_fixed(const Frozen& frozen, Stage& stage, std::uint32_t index)
{
    const HipDescription& hips = frozen.hips;
    const HipInput& hip = stage.hips[index];
    HipTouch& touch = stage.touches[index];
    Memory& memory = memory_[index];
    const PerAxis place = per_axis(hip.position.value);
    const PerAxis velocity = per_axis(hip.velocity.value);
    const double sweep = frozen.tick * largest(beyond(velocity, {})) + hips.radius_m;
    const PerAxis gone = beyond(difference(hip.position.value, memory.seen_from), {});
    if (largest(gone) + sweep < memory.clear) return;
    memory.seen_from = place;
    memory.clear = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < fixed_.size(); ++i) {
        const Approach approach{.from_centre = difference(hip.position.value, fixed_[i].centre),
                                .velocity = velocity,
                                .radius = hips.radius_m,
                                .tick = frozen.tick};
        EnteredFace& entered = entered_fixed_[index * fixed_.size() + i];
        const double apart = largest(beyond(approach.from_centre, fixed_[i].half));
        memory.clear = std::min(memory.clear, apart);
        if (apart >= sweep) {
            entered = {};
            continue;
        }
        const auto meeting = meet(approach, fixed_[i].half, entered);
        if (!meeting) continue;
        const double closing = -dot(meeting->normal, velocity);
        const double mean =
            steady_impulse(hips, meeting->depth, closing, frozen.tick) / frozen.tick;
        touch.depth_m = std::max(touch.depth_m, meeting->depth);
        touch.on_hip.value += mean * vector(meeting->normal);
        touch.on_hip_at_start.value +=
            force_at(hips, meeting->depth, closing) * vector(meeting->normal);
    }
}

void SlidingHands::press_slanted(Slide& slide)
{
    const HipDescription& hips = slide.hips;
    const double half_tick = 0.5 * slide.left;
    for (SlantedSpring& spring : slide.active_slanted()) {
        const PerAxis& normal = spring.normal;
        double closing = spring.closing;
        double bend = 0.0; // of the depth, without this spring
        double ease = 0.0; // 1/mass along the normal
        for (std::size_t i = 0; i < 3; ++i) {
            if (!slide.courses[i].moves()) continue;
            closing += normal[i] * slide.velocity[i];
            bend += normal[i] * slide.axes[i].acceleration;
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
        for (std::size_t i = 0; i < 3; ++i) {
            const double change = -slide.inverse_mass * spring.force * normal[i];
            slide.axes[i].steady += change;
            if (slide.courses[i].moves()) slide.axes[i].acceleration += change;
        }
    }
}

void SlidingHands::report(const Frozen& frozen, Stage& stage, const Slide& slide)
{
    for (const Spring& spring : slide.active_springs()) {
        stage.touches[spring.hip].on_body.value[static_cast<int>(spring.axis)] -=
            spring.sign * std::max(spring.impulse / frozen.tick, 0.0);
    }
    for (const SlantedSpring& spring : slide.active_slanted()) {
        stage.touches[spring.hip].on_body.value -= spring.force * vector(spring.normal);
    }
    for (const Grip& grip : slide.active_grips()) {
        stage.touches[grip.hip].on_body.value += vector(grip.impulse) / frozen.tick;
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

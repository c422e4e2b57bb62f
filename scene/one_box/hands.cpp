// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/hands.hpp"

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

/// The axis along which a place is outside of a box, by less than `reach`; no_axis when it is
/// inside, farther away, or outside along more than one.
std::size_t before_face(const PerAxis& out, double reach)
{
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(out[i] > 0.0)) continue;
        const bool is_straight = !(out[(i + 1) % 3] > 0.0) && !(out[(i + 2) % 3] > 0.0);
        return is_straight && out[i] < reach ? i : no_axis;
    }
    return no_axis;
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

/// One part of a vector.
template <typename Vector>
auto& part(Vector& v, std::size_t axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// The spring and damper alone, at one moment.
double spring_force(const HipDescription& hips, double depth, double closing)
{
    if (depth <= 0.0) return 0.0;
    return std::clamp(hips.stiffness_n_per_m * depth + hips.damping_ns_per_m * closing, 0.0,
                      hips.force_max_n);
}

/// A hand that holds with the same force throughout the tick.
void hold_steadily(HipTouch& touch, Slide& slide, base::Force force)
{
    touch.on_body = force;
    touch.on_hip += -force;
    const PerAxis held = per_axis(force.value);
    for (std::size_t i = 0; i < 3; ++i) slide.axes[i].steady += slide.laws.inverse_mass() * held[i];
}

/// Adds the spring between a hand and a face of the box.
void push_face(Stage& stage, Slide& slide, const FaceTouch& found)
{
    const std::size_t axis = found.face.axis;
    const double speed = slide.velocity[axis];
    Spring& spring = slide.springs[slide.spring_count++];
    spring.hip = found.hip;
    spring.axis = axis;
    spring.sign = found.face.sign;
    spring.depth = found.depth;
    spring.closing = -spring.sign * part(stage.hips[found.hip].velocity.value, axis);
    spring.impulse = 0.0;
    const double force = spring.settle(slide.hips, speed);
    HipTouch& touch = stage.touches[found.hip];
    touch.depth_m = std::max(touch.depth_m, found.depth);
    part(touch.on_hip_at_start.value, axis) += spring.sign * force;
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
        if (!memory.is_clear(frozen, hip)) touch_fixed(frozen, stage, i);
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
    touch.holding = touch.touching = true;
    touch.depth_m =
        std::max(touch.depth_m, std::max(hips.radius_m - distance(from_centre, half_), 0.0));
    touch.on_hip_at_start += -force;
    if (force == wanted) {
        slide.grips[slide.grip_count++] = grip;
        return;
    }
    hold_steadily(touch, slide, force);
}

inline void SlidingHands::touch_box(const Frozen& frozen, Stage& stage, Slide& slide,
                                    std::uint32_t index)
{
    const double radius = frozen.hips.radius_m;
    const PerAxis from_centre = difference(stage.hips[index].position.value, slide.place);
    const PerAxis out = beyond(from_centre, half_);
    const std::size_t axis = before_face(out, radius);
    FaceTouch found{index, {}, 0.0};
    if (axis != no_axis) { // as nearly always when it pushes
        found.face = memory_[index].entered = face_at(axis, from_centre[axis]);
        found.depth = radius - out[axis];
    } else {
        found = meet_box(frozen, stage, slide, index);
    }
    if (found.face.axis != no_axis) push_face(stage, slide, found);
}

FaceTouch SlidingHands::meet_box(const Frozen& frozen, Stage& stage, Slide& slide,
                                 std::uint32_t index)
{
    const HipDescription& hips = frozen.hips;
    const HipInput& hip = stage.hips[index];
    EnteredFace& entered = memory_[index].entered;
    const Approach approach{.from_centre = difference(hip.position.value, slide.place),
                            .velocity = difference(hip.velocity.value, slide.velocity),
                            .radius = hips.radius_m,
                            .tick = frozen.tick};
    const double far = hips.radius_m + margin_;
    for (std::size_t i = 0; i < 3; ++i) {
        const double swept = 2.0 * frozen.tick * std::abs(approach.velocity[i]);
        if (std::abs(approach.from_centre[i]) > half_[i] + far + swept) {
            entered = {};
            return {index, {}, 0.0};
        }
    }
    const auto meeting = meet(approach, half_, entered);
    if (!meeting) return {index, {}, 0.0};
    if (meeting->face.axis != no_axis) return {index, meeting->face, meeting->depth};
    HipTouch& touch = stage.touches[index];
    const PerAxis& normal = meeting->oblique;
    const double closing = -dot(normal, per_axis(hip.velocity.value));
    slide.slanted[slide.slanted_count++] = {index, normal, meeting->depth, closing, 0.0};
    touch.depth_m = std::max(touch.depth_m, meeting->depth);
    touch.on_hip_at_start.value +=
        spring_force(hips, meeting->depth, -dot(normal, approach.velocity)) * vector(normal);
    return {index, {}, 0.0};
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
        PerAxis normal = meeting->oblique;
        if (meeting->face.axis != no_axis) normal[meeting->face.axis] = meeting->face.sign;
        const double closing = -dot(normal, velocity);
        const double mean =
            steady_impulse(hips, meeting->depth, closing, frozen.tick) / frozen.tick;
        touch.depth_m = std::max(touch.depth_m, meeting->depth);
        touch.on_hip.value += mean * vector(normal);
        touch.on_hip_at_start.value += spring_force(hips, meeting->depth, closing) * vector(normal);
    }
}

void SlidingHands::press_slanted(Slide& slide)
{
    const HipDescription& hips = slide.hips;
    const double half_tick = 0.5 * slide.left;
    const bool is_stuck = slide.rubbing.state == Rubbing::State::stuck;
    const auto is_kept = [&](std::size_t i) { return is_stuck || slide.axes[i].is_held(); };
    for (SlantedSpring& spring : slide.active_slanted()) {
        const PerAxis& normal = spring.normal;
        double closing = spring.closing;
        double bend = 0.0; // of the depth, without this spring
        double ease = 0.0; // 1/mass along the normal
        for (std::size_t i = 0; i < 3; ++i) {
            if (is_kept(i)) continue;
            closing += normal[i] * slide.velocity[i];
            bend += normal[i] * slide.axes[i].acceleration;
            ease += normal[i] * normal[i] * slide.laws.inverse_mass();
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
            const double change = -slide.laws.inverse_mass() * spring.force * normal[i];
            slide.axes[i].steady += change;
            if (!is_kept(i)) slide.axes[i].acceleration += change;
        }
    }
}

bool SlidingHands::weaken(const Frozen& frozen, Stage& stage, const Slide& slide, Slide& again)
{
    constexpr double rounding = 1e-12;
    const double most = frozen.tick * frozen.hips.force_max_n;
    for (std::uint32_t n = 0; n < slide.grip_count; ++n) {
        const PerAxis& impulse = slide.grips[n].impulse;
        const double size = std::sqrt(dot(impulse, impulse));
        if (size <= (1.0 + rounding) * most) continue;
        const base::Force force{(frozen.hips.force_max_n / size) * vector(impulse)};
        hold_steadily(stage.touches[slide.grips[n].hip], again, force);
        again.grips[n] = again.grips[--again.grip_count];
        return true;
    }
    return false;
}

void SlidingHands::report(const Frozen& frozen, Stage& stage, const Slide& slide)
{
    const double per_tick = 1.0 / frozen.tick;
    for (const Spring& spring : slide.active_springs()) {
        if (spring.impulse <= 0.0) continue;
        HipTouch& touch = stage.touches[spring.hip];
        const double force = spring.sign * (spring.impulse * per_tick);
        touch.touching = true;
        part(touch.on_body.value, spring.axis) -= force;
        part(touch.on_hip.value, spring.axis) += force;
    }
    for (const SlantedSpring& spring : slide.active_slanted()) {
        if (spring.force <= 0.0) continue;
        HipTouch& touch = stage.touches[spring.hip];
        touch.touching = true;
        touch.on_body.value -= spring.force * vector(spring.normal);
        touch.on_hip.value += spring.force * vector(spring.normal);
    }
    for (const Grip& grip : slide.active_grips()) {
        HipTouch& touch = stage.touches[grip.hip];
        touch.on_body.value += per_tick * vector(grip.impulse);
        touch.on_hip.value -= per_tick * vector(grip.impulse);
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

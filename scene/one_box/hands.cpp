// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/one_box/hands.hpp"

#include <cmath>

namespace hapnet::scene {

namespace {

double largest(const PerAxis& a) { return std::max(std::max(a[0], a[1]), a[2]); }

/// Returns the distance of a place outside of a box along each axis; < 0: inside.
PerAxis beyond(const PerAxis& from_centre, const PerAxis& half)
{
    return {std::abs(from_centre[0]) - half[0], std::abs(from_centre[1]) - half[1],
            std::abs(from_centre[2]) - half[2]};
}

/// Returns the axis along which a place is outside of a box, by less than `reach`. Returns no_axis
/// when the place is inside, farther away, or outside along more than one axis.
std::size_t face_axis(const PerAxis& out, double reach)
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

/// Returns one component of a vector.
template <typename Vector>
auto& part(Vector& v, std::size_t axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/// Applies the grip of a hand that holds with the same force throughout the tick.
void apply_constant_grip(HandTouch& touch, BoxMotion& box, base::Force force)
{
    touch.on_body = force;
    touch.on_hand += -force;
    const PerAxis held = per_axis(force.value);
    for (std::size_t i = 0; i < 3; ++i) {
        box.axes[i].applied_acceleration += box.oscillators.inverse_mass() * held[i];
    }
}

/// Reports the springs that are not at a face.
void report_inexact(const WorldConfig& config, WorldState& state, const BoxMotion& box)
{
    const double per_tick = 1.0 / config.tick;
    for (const HeldSpring& spring : box.active_held()) {
        if (spring.force <= 0.0) continue;
        HandTouch& touch = state.touches[spring.hand];
        touch.touching = true;
        touch.on_body.value -= spring.force * vector(spring.normal);
        touch.on_hand.value += spring.force * vector(spring.normal);
    }
    for (const SlantedSpring& spring : box.active_slanted()) {
        if (spring.impulse <= 0.0) continue;
        HandTouch& touch = state.touches[spring.hand];
        const glm::dvec3 force = (per_tick * spring.impulse) * vector(spring.normal);
        touch.touching = true;
        touch.on_body.value -= force;
        touch.on_hand.value += force;
    }
    for (const GripSpring& grip : box.active_grips()) {
        HandTouch& touch = state.touches[grip.hand];
        touch.on_body.value += per_tick * vector(grip.impulse);
        touch.on_hand.value -= per_tick * vector(grip.impulse);
    }
}

/// Adds the spring between a hand and a face of the box.
void add_face_spring(WorldState& state, BoxMotion& box, const FaceContact& found)
{
    const std::size_t axis = found.face.axis;
    FaceSpring& spring = box.springs[box.spring_count++];
    spring.hand = found.hand;
    spring.axis = axis;
    spring.sign = found.face.sign;
    spring.depth = found.depth;
    spring.closing = -spring.sign * part(state.hands[found.hand].velocity.value, axis);
    spring.impulse = 0.0;
    const double force = spring.update_phase(box.hands, spring.along(box.velocity));
    HandTouch& touch = state.touches[found.hand];
    touch.depth_m = std::max(touch.depth_m, found.depth);
    part(touch.on_hand_at_start.value, axis) += spring.sign * force;
}

} // namespace

BoxHands::BoxHands(const WorldConfig& config, const Bodies& bodies, const BodyProperties& movable)
    : body_{movable.id},
      half_{per_axis(movable.half)},
      margin_{std::min(std::min(movable.half.x, movable.half.y), movable.half.z)}
{
    for (const Slot slot : bodies.slot_of) {
        if (bodies.properties[slot].mass > 0.0) continue;
        fixed_.push_back(
            {per_axis(bodies.position.at(slot)), per_axis(bodies.properties[slot].half)});
    }
    entered_fixed_.resize(config.hands.count * fixed_.size());
}

void BoxHands::collide(const WorldConfig& config, WorldState& state, BoxMotion& box)
{
    for (std::uint32_t i = 0; i < config.hands.count; ++i) {
        const HandInput& input = state.hands[i];
        state.touches[i] = HandTouch{.body = body_};
        Memory& memory = memory_[i];
        if (!input.present) {
            memory.entered = {};
            memory.held_at.reset();
            continue;
        }
        if (!memory.is_clear(config, input)) collide_fixed_boxes(config, state, i);
        if (!input.gripping) {
            memory.held_at.reset();
        } else if (!memory.held_at) {
            const PerAxis from_centre = difference(input.position.value, box.position);
            if (distance(from_centre, half_) <= grip_distance(config.hands))
                memory.held_at = from_centre;
        }
        if (memory.held_at) {
            add_grip(config, state, box, i);
        } else {
            collide_box(config, state, box, i);
        }
    }
}

void BoxHands::add_grip(const WorldConfig& config, WorldState& state, BoxMotion& box,
                        std::uint32_t index)
{
    const HandDescription& hands = config.hands;
    const HandInput& input = state.hands[index];
    Memory& memory = memory_[index];
    memory.entered = {};
    const PerAxis from_centre = difference(input.position.value, box.position);
    GripSpring grip{index, from_centre, per_axis(input.velocity.value), {}};
    for (std::size_t i = 0; i < 3; ++i) grip.stretch[i] -= (*memory.held_at)[i];
    const base::Force wanted =
        grip_force(hands, vector(grip.stretch), input.velocity.value - vector(box.velocity));
    const base::Force force = base::limited(wanted, hands.force_max_n);
    HandTouch& touch = state.touches[index];
    touch.touching = true;
    note_grip(touch, hands, distance(from_centre, half_), force);
    box.is_exact = false;
    if (force == wanted) {
        box.grips[box.grip_count++] = grip;
        return;
    }
    apply_constant_grip(touch, box, force);
}

inline void BoxHands::collide_box(const WorldConfig& config, WorldState& state, BoxMotion& box,
                                  std::uint32_t index)
{
    const double radius = config.hands.radius_m;
    const PerAxis from_centre = difference(state.hands[index].position.value, box.position);
    const PerAxis out = beyond(from_centre, half_);
    const std::size_t axis = face_axis(out, radius);
    FaceContact found{index, {}, 0.0};
    if (axis != no_axis) { // as nearly always when the hand pushes
        found.face = memory_[index].entered = face_at(axis, from_centre[axis]);
        found.depth = radius - out[axis];
    } else {
        found = collide_near_box(config, state, box, index);
    }
    if (found.face.axis != no_axis) add_face_spring(state, box, found);
}

FaceContact BoxHands::collide_near_box(const WorldConfig& config, WorldState& state, BoxMotion& box,
                                       std::uint32_t index)
{
    const HandDescription& hands = config.hands;
    const HandInput& input = state.hands[index];
    BoxFace& entered = memory_[index].entered;
    const SphereMotion approach{.from_centre = difference(input.position.value, box.position),
                                .velocity = difference(input.velocity.value, box.velocity),
                                .radius = hands.radius_m,
                                .tick = config.tick};
    const double far = hands.radius_m + margin_;
    for (std::size_t i = 0; i < 3; ++i) {
        const double swept = 2.0 * config.tick * std::abs(approach.velocity[i]);
        if (std::abs(approach.from_centre[i]) > half_[i] + far + swept) {
            entered = {};
            return {index, {}, 0.0};
        }
    }
    const auto contact = collide_sphere(approach, half_, entered);
    if (!contact) return {index, {}, 0.0};
    if (contact->face.axis != no_axis) return {index, contact->face, contact->depth};
    HandTouch& touch = state.touches[index];
    const PerAxis& normal = contact->edge_normal;
    const double closing = -dot(normal, per_axis(input.velocity.value));
    if (box.oscillators.are_soft()) {
        box.held[box.held_count++] = {index, normal, contact->depth, closing, 0.0};
    } else {
        SlantedSpring& spring = box.slanted[box.slanted_count++];
        spring.hand = index;
        spring.normal = normal;
        spring.depth = contact->depth;
        spring.closing = closing;
        spring.impulse = 0.0;
        spring.update_phase(hands, spring.along(box.velocity));
    }
    const double force = force_at(hands, contact->depth, -dot(normal, approach.velocity));
    note_push(touch, contact->depth, force * vector(normal));
    box.is_exact = false;
    return {index, {}, 0.0};
}

void BoxHands::collide_fixed_boxes(const WorldConfig& config, WorldState& state,
                                   std::uint32_t index)
{
    const HandDescription& hands = config.hands;
    const HandInput& input = state.hands[index];
    HandTouch& touch = state.touches[index];
    Memory& memory = memory_[index];
    const PerAxis place = per_axis(input.position.value);
    const PerAxis velocity = per_axis(input.velocity.value);
    const double sweep = config.tick * largest(beyond(velocity, {})) + hands.radius_m;
    memory.query_position = place;
    memory.clear = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < fixed_.size(); ++i) {
        const SphereMotion approach{.from_centre =
                                        difference(input.position.value, fixed_[i].centre),
                                    .velocity = velocity,
                                    .radius = hands.radius_m,
                                    .tick = config.tick};
        BoxFace& entered = entered_fixed_[index * fixed_.size() + i];
        const double apart = largest(beyond(approach.from_centre, fixed_[i].half));
        memory.clear = std::min(memory.clear, apart);
        if (apart >= sweep) {
            entered = {};
            continue;
        }
        const auto contact = collide_sphere(approach, fixed_[i].half, entered);
        if (!contact) continue;
        PerAxis normal = contact->edge_normal;
        if (contact->face.axis != no_axis) normal[contact->face.axis] = contact->face.sign;
        const double closing = -dot(normal, velocity);
        const double mean =
            impulse_at_constant_velocity(hands, contact->depth, closing, config.tick) / config.tick;
        touch.depth_m = std::max(touch.depth_m, contact->depth);
        touch.on_hand.value += mean * vector(normal);
        touch.on_hand_at_start.value += force_at(hands, contact->depth, closing) * vector(normal);
    }
}

void BoxHands::add_held_springs(BoxMotion& box)
{
    const HandDescription& hands = box.hands;
    const double half_tick = 0.5 * box.time_left;
    const bool is_stuck = box.dry_friction.state == DryFriction::State::stuck;
    const auto is_kept = [&](std::size_t i) { return is_stuck || box.axes[i].is_held(); };
    for (HeldSpring& spring : box.active_held()) {
        const PerAxis& normal = spring.normal;
        double closing = spring.closing;
        double bend = 0.0; // acceleration of the depth, without this spring
        double ease = 0.0; // 1/mass along the normal
        for (std::size_t i = 0; i < 3; ++i) {
            if (is_kept(i)) continue;
            closing += normal[i] * box.velocity[i];
            bend += normal[i] * box.axes[i].acceleration;
            ease += normal[i] * normal[i] * box.oscillators.inverse_mass();
        }
        // depth and closing speed in the middle are linear in the force that acts meanwhile.
        const double answer =
            hands.stiffness_n_per_m * half_tick * half_tick + hands.damping_ns_per_m * half_tick;
        const double depth = spring.depth + half_tick * closing;
        const double free_force =
            hands.stiffness_n_per_m * depth + hands.damping_ns_per_m * closing + answer * bend;
        spring.force = std::clamp(free_force / (1.0 + answer * ease), 0.0, hands.force_max_n);
        if (depth + half_tick * half_tick * (bend - ease * spring.force) <= 0.0) spring.force = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double change = -box.oscillators.inverse_mass() * spring.force * normal[i];
            box.axes[i].applied_acceleration += change;
            if (!is_kept(i)) box.axes[i].acceleration += change;
        }
    }
}

bool BoxHands::limit_grip(const WorldConfig& config, WorldState& state, const BoxMotion& box,
                          BoxMotion& again)
{
    constexpr double rounding = 1e-12;
    const double most = config.tick * config.hands.force_max_n;
    for (std::uint32_t n = 0; n < box.grip_count; ++n) {
        const PerAxis& impulse = box.grips[n].impulse;
        const double size = std::sqrt(dot(impulse, impulse));
        if (size <= (1.0 + rounding) * most) continue;
        const base::Force force{(config.hands.force_max_n / size) * vector(impulse)};
        apply_constant_grip(state.touches[box.grips[n].hand], again, force);
        again.grips[n] = again.grips[--again.grip_count];
        return true;
    }
    return false;
}

void BoxHands::report(const WorldConfig& config, WorldState& state, const BoxMotion& box)
{
    const double per_tick = 1.0 / config.tick;
    for (const FaceSpring& spring : box.active_springs()) {
        if (spring.impulse <= 0.0) continue;
        HandTouch& touch = state.touches[spring.hand];
        const double force = spring.sign * (spring.impulse * per_tick);
        touch.touching = true;
        part(touch.on_body.value, spring.axis) -= force;
        part(touch.on_hand.value, spring.axis) += force;
    }
    if (!box.is_exact) report_inexact(config, state, box);
}

double BoxHands::stored_in_grips(const WorldConfig& config, const WorldState& state,
                                 const PerAxis& box_position) const
{
    const HandDescription& hands = config.hands;
    const double bend = hands.force_max_n / hands.stiffness_n_per_m;
    double sum = 0.0;
    for (std::uint32_t i = 0; i < hands.count; ++i) {
        if (!memory_[i].held_at) continue;
        PerAxis stretch = difference(state.hands[i].position.value, box_position);
        for (std::size_t k = 0; k < 3; ++k) stretch[k] -= (*memory_[i].held_at)[k];
        const double size = std::sqrt(dot(stretch, stretch));
        sum += size < bend ? 0.5 * hands.stiffness_n_per_m * size * size
                           : hands.force_max_n * (size - 0.5 * bend);
    }
    return sum;
}

void BoxHands::forget_box()
{
    for (Memory& memory : memory_) {
        memory.entered = {};
        memory.held_at.reset();
    }
}

} // namespace hapnet::scene

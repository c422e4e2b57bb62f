// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/integrate.hpp"

#include "proto/base/math.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"
#include "scene/rigid/free_flight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

/// The distance by which the correction of overlaps may throw such a body off its path, in half
/// edges of the smallest body. One contact may move it that far, see correction_max.
constexpr double stray_max = 0.1;

/// Returns the part of a displacement or velocity along unlocked axes.
glm::dvec3 unlocked_part(const glm::dvec3& light, const glm::dvec3& way)
{
    return {light.x > 0.0 ? way.x : 0.0, light.y > 0.0 ? way.y : 0.0, light.z > 0.0 ? way.z : 0.0};
}

/// True if a turn is too small to change an orientation.
bool is_negligible(const glm::dvec3& angle)
{
    constexpr double nothing = 1e-18;
    return std::abs(angle.x) < nothing && std::abs(angle.y) < nothing &&
           std::abs(angle.z) < nothing;
}

glm::dvec3 tangential_part(const glm::dvec3& v, const glm::dvec3& normal)
{
    return v - glm::dot(v, normal) * normal;
}

/// Returns the acceleration by everything but the hands and the drag.
glm::dvec3 acceleration_without_hands(const BodyIntegration& integration, const WorldState& state,
                                      Slot slot, const WorldConfig& config)
{
    const BodyProperties& properties = state.bodies.properties[slot];
    return gravity_on(properties, config.gravity) +
           properties.inverse_mass *
               ((1.0 / config.tick) * integration.contact_impulse + state.pushes[properties.id]);
}

void set_start(BodyIntegration& integration, const WorldState& state, Slot slot,
               const BodyResponse& response)
{
    const Bodies& bodies = state.bodies;
    const glm::dvec3 momentum = bodies.angular_momentum.at(slot);
    integration.contact_angular_impulse =
        about_unlocked_axes(bodies.properties[slot], integration.contact_angular_impulse);
    integration.start = {bodies.velocity.at(slot), response.inverse_inertia * momentum,
                         glm::dvec3{0.0}};
}

double kinetic_energy(const BodyProperties& properties, const MovingBody& body)
{
    const glm::dvec3 spin =
        Bodies::apply_inverse_inertia(properties, body.orientation, body.angular_momentum);
    return 0.5 * (properties.mass * glm::dot(body.velocity, body.velocity) +
                  glm::dot(body.angular_momentum, spin));
}

glm::dquat orientation_at_end(const BodyIntegration& integration, const Bodies& bodies, Slot slot,
                              const BodyMotion& mean, double tick)
{
    if (integration.has_hands) {
        const glm::dvec3 more = tick * (mean.spin - integration.mean_to_there.spin);
        return is_negligible(more) ? integration.orientation
                                   : rotated(integration.orientation, more);
    }
    const glm::dquat now = bodies.orientation.at(slot);
    if (is_negligible(tick * mean.spin)) return now;
    const BodyProperties& properties = bodies.properties[slot];
    if (rotates_uniformly(properties)) return rotated(now, tick * mean.spin);
    if (integration.contact_angular_impulse == glm::dvec3{0.0} &&
        mean.angular_impulse == glm::dvec3{0.0})
        return rotated_freely(now, {bodies.angular_momentum.at(slot), properties.inverse_inertia},
                              tick);
    return rotated(now, tick * spin_through_tick(integration, bodies, slot, mean, tick));
}

} // namespace

BodyResponse response_of(const BodyProperties& properties, const glm::dmat3& axes)
{
    const glm::dvec3& about = properties.inverse_inertia;
    BodyResponse response{properties.inverse_mass, glm::dmat3{0.0}};
    if (rotates_uniformly(properties)) {
        for (int i = 0; i < 3; ++i) response.inverse_inertia[i][i] = about[i];
        return response;
    }
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            double sum = 0.0;
            for (int own = 0; own < 3; ++own) {
                sum += axes[own][row] * about[own] * axes[own][column];
            }
            response.inverse_inertia[column][row] = sum;
        }
    }
    return response;
}

void reset(BodyIntegration& integration)
{
    integration.contact_impulse = glm::dvec3{0.0};
    integration.contact_angular_impulse = glm::dvec3{0.0};
    integration.bounce_angular_impulse = glm::dvec3{0.0};
    integration.bounce_angular_impulse_mean = glm::dvec3{0.0};
    integration.friction_contacts = 0;
    integration.drag = 0.0;
    integration.has_hands = false;
    integration.own_work = 0.0;
    integration.driven = {};
    integration.first_touch.time = std::numeric_limits<double>::infinity();
}

void begin_again(BodyIntegration& integration, const glm::dvec3& twist)
{
    integration.contact_impulse = glm::dvec3{0.0};
    integration.contact_angular_impulse = twist;
    integration.bounce_angular_impulse = glm::dvec3{0.0};
    integration.bounce_angular_impulse_mean = glm::dvec3{0.0};
    integration.own_work = 0.0;
    integration.driven = {};
}

void begin_bounces(BodyIntegration& integration)
{
    integration.start_after_bounces = integration.start;
    integration.bounce_offset = {};
    integration.last_bounce = 0.0;
}

glm::dvec3 spin_through_tick(const BodyIntegration& integration, const Bodies& bodies, Slot slot,
                             const BodyMotion& mean, double tick)
{
    const BodyProperties& properties = bodies.properties[slot];
    if (rotates_uniformly(properties)) return mean.spin;
    const glm::dvec3 momentum = bodies.angular_momentum.at(slot) +
                                0.5 * integration.contact_angular_impulse + mean.angular_impulse;
    return mean_spin(bodies.orientation.at(slot), {momentum, properties.inverse_inertia}, tick);
}

void integrate_velocity(BodyIntegration& integration, const WorldState& state, Slot slot,
                        const BodyResponse& response, const WorldConfig& config)
{
    const double tick = config.tick;
    set_start(integration, state, slot, response);
    integration.angular_momentum =
        state.bodies.angular_momentum.at(slot) + integration.contact_angular_impulse;
    const glm::dvec3 rate = acceleration_without_hands(integration, state, slot, config);
    const glm::dvec3& before = integration.start.velocity;
    integration.predicted = {before + tick * rate,
                             response.inverse_inertia * integration.angular_momentum,
                             glm::dvec3{0.0}};
    if (!rotates_uniformly(state.bodies.properties[slot])) {
        // A body's moments of inertia turn with it: the angular momentum stays, the spin does not.
        // For a body that rotates far in a tick this rate is wrong, so it fades out. It is computed
        // with the momentum at the start, as wedged contacts may add any amount.
        constexpr double far = 0.3; // radians
        const glm::dvec3& spin = integration.start.spin;
        const double fades = std::min(1.0, tick * tick * glm::dot(spin, spin) / (far * far));
        integration.predicted.spin +=
            ((1.0 - fades) * tick) *
            (response.inverse_inertia * glm::cross(state.bodies.angular_momentum.at(slot), spin));
    }
    integration.mean = {before + (0.5 * tick) * rate,
                        0.5 * (integration.start.spin + integration.predicted.spin),
                        glm::dvec3{0.0}};
    if (integration.drag == 0.0) return;
    // Under drag the velocity along the plane approaches its final value exponentially.
    const glm::dvec3& light = response.inverse_mass;
    const double keeps = base::exp(-integration.drag * tick);
    const glm::dvec3 driven =
        unlocked_part(light, tangential_part(rate, integration.support_normal));
    const glm::dvec3 excess =
        unlocked_part(light, tangential_part(before, integration.support_normal)) -
        driven / integration.drag;
    const glm::dvec3 lost = (1.0 - keeps) * excess;
    integration.predicted.velocity += -lost - tick * driven;
    integration.mean.velocity += lost / (integration.drag * tick) - excess - (0.5 * tick) * driven;
}

VelocityChange change_within(const BodyIntegration& integration, const BodyResponse& response,
                             const glm::dvec3& change, double share_left, double tick)
{
    VelocityChange found{change, share_left * change};
    if (integration.drag == 0.0) return found;
    const double rate = integration.drag * tick;
    const double keeps = base::exp(-rate * share_left);
    const glm::dvec3 along =
        unlocked_part(response.inverse_mass, tangential_part(change, integration.support_normal));
    found.at_end -= (1.0 - keeps) * along;
    found.mean += ((1.0 - keeps) / rate - share_left) * along;
    return found;
}

BodyDynamics dynamics_of(const BodyIntegration& integration, const WorldState& state, Slot slot,
                         const BodyResponse& response, const WorldConfig& config)
{
    const BodyProperties& properties = state.bodies.properties[slot];
    return {properties.half,
            response.inverse_mass,
            response.inverse_inertia,
            rotates_uniformly(properties),
            acceleration_without_hands(integration, state, slot, config),
            (1.0 / config.tick) * integration.contact_angular_impulse,
            integration.drag,
            integration.support_normal,
            properties.rounding,
            properties.has_parts() ? properties.inertia : glm::dvec3{0.0}};
}

void integrate_velocity_with_hands(BodyIntegration& integration, const WorldState& state, Slot slot,
                                   const BodyResponse& response, const HandForces& hands)
{
    const WorldConfig& config = hands.config;
    const Bodies& bodies = state.bodies;
    set_start(integration, state, slot, response);
    const double per_second = 1.0 / config.tick;
    const BodyDynamics dynamics = dynamics_of(integration, state, slot, response, config);
    const MovingBody start{bodies.position.at(slot), bodies.orientation.at(slot),
                           integration.start.velocity, bodies.angular_momentum.at(slot)};
    MovingBody body = start;
    const HandEnergy energy =
        hands.frictions.empty()
            ? advance(body, dynamics, hands.springs, hands.work, config.tick, hands.modes)
            : advance_with_friction(body, dynamics, {hands.springs, hands.frictions, hands.work},
                                    config.tick);
    integration.hands_are_braked = energy.is_braked;
    integration.hand_rows = energy.rows;
    integration.has_hands = true;
    integration.position = body.position;
    integration.orientation = body.orientation;
    integration.angular_momentum =
        about_unlocked_axes(bodies.properties[slot], body.angular_momentum);
    integration.predicted.velocity = body.velocity;
    integration.predicted.spin = response.inverse_inertia * body.angular_momentum;
    integration.predicted.angular_impulse = glm::dvec3{0.0};
    integration.mean.velocity = per_second * (body.position - start.position);
    integration.mean.spin = 0.5 * (integration.start.spin + integration.predicted.spin);
    integration.mean.angular_impulse = glm::dvec3{0.0};
    integration.mean_to_there = integration.mean;
    // The energy that the body gained beyond the work of constant forces.
    const double more = kinetic_energy(bodies.properties[slot], body) -
                        kinetic_energy(bodies.properties[slot], start) -
                        bodies.properties[slot].mass *
                            glm::dot(dynamics.acceleration, body.position - start.position) -
                        config.tick * glm::dot(dynamics.torque, integration.mean.spin);
    integration.own_work = more;
}

void apply_stop(const ContactBlock& block, const SlidingBody& body,
                const BodyProperties& properties, const Scales& scales, BodyMotion& mean)
{
    const BodyIntegration& integration = body.integration;
    const double sign = body.is_second ? 1.0 : -1.0;
    const glm::dvec3 set_start = integration.start.velocity - body.ground;
    const glm::dvec3 slip = unlocked_part(
        properties.inverse_mass, set_start - glm::dot(set_start, block.normal) * block.normal);
    const double speed = std::sqrt(glm::dot(slip, slip));
    constexpr double hardly = 1e-9;
    if (speed <= hardly * scales.speed) return;
    // For a body that rotates, the centre's velocity is not the slip at the contact.
    constexpr double steadily = 1e-6;
    const double turning2 = glm::dot(integration.start.spin, integration.start.spin);
    const double across2 = glm::dot(properties.half, properties.half);
    if (turning2 * across2 > steadily * steadily * speed * speed) return;
    const glm::dvec3 along = slip / speed;
    const double held = sign * (block.impulse.tangent_1 * glm::dot(block.tangent_1, along) +
                                block.impulse.tangent_2 * glm::dot(block.tangent_2, along));
    // The other forces along the slip, which brought the body to a stop together with the friction.
    const double other = -properties.mass * speed - held;
    const double braking = block.friction_limit() - other;
    if (!(braking > properties.mass * speed)) return;
    const double share = properties.mass * speed / braking; // share of the tick until the stop
    mean.velocity -= (0.5 * (1.0 - share)) * slip;
}

void stop_sliding_contacts(const Bodies& bodies, const Scales& scales, ContactSolver& solver,
                           std::span<const BodyIntegration> integrations)
{
    const auto stop = [&](const ContactBlock& block, SolverIndex index, const glm::dvec3& ground) {
        const BodyProperties& body = bodies.properties[index - 1];
        if (integrations[index].friction_contacts != 1 || rolls(body)) return;
        apply_stop(block, {integrations[index], ground, index == block.b}, body, scales,
                   solver.mean_motion(index));
    };
    for (const ContactBlock& block : solver.blocks()) {
        if (block.friction == 0.0) continue;
        if (block.a == 0 || block.b == 0) {
            stop(block, block.a + block.b, glm::dvec3{0.0});
        } else if (solver.responds(block.a) != solver.responds(block.b)) {
            const SolverIndex index = solver.responds(block.a) ? block.a : block.b;
            const BodyMotion& ground = integrations[block.a + block.b - index].start;
            if (ground.spin == glm::dvec3{0.0}) stop(block, index, ground.velocity);
        }
    }
}

void warm_start(ContactSolver& solver, std::span<BodyIntegration> integrations)
{
    const auto add = [&](SolverIndex index, const glm::dvec3& arm, const Wrench& push,
                         double sign) {
        if (!solver.responds(index)) return;
        BodyIntegration& body = integrations[index];
        body.contact_impulse += sign * push.impulse;
        body.contact_angular_impulse += sign * (glm::cross(arm, push.impulse) + push.angular);
    };
    for (const ContactBlock& block : solver.blocks()) {
        add(block.b, block.arm_b, block.start_push, 1.0);
        add(block.a, block.arm_a, block.start_push, -1.0);
    }
}

Ways keep_within_swept_path(const WorldState& state, std::span<const Slot> slots,
                            std::span<const BodyIntegration> integrations, ContactSolver& solver,
                            const Scales& scales)
{
    Ways ways;
    for (const Slot slot : slots) {
        const SolverIndex i = slot + 1;
        BodyMotion& mean = solver.mean_motion(i);
        glm::dvec3& way = mean.velocity;
        const double half = sum_of_sizes(state.bodies.properties[slot].half);
        const double least = integrations[i].least_near;
        const double most = far_way * least * scales.rate;
        const double aside = stray_max * least * scales.rate;
        if (sum_of_sizes(way) + half * sum_of_sizes(mean.spin) <= most) continue;
        ways.any_far = true;
        const BodyIntegration& integration = integrations[i];
        const BodyMotion& end = solver.end_motion(i);
        const auto kept = [&](const glm::dvec3& now, const glm::dvec3& from, const glm::dvec3& to,
                              const glm::dvec3& with_hands, double stray) {
            glm::dvec3 low = glm::min(glm::min(from, to), glm::dvec3{0.0});
            glm::dvec3 high = glm::max(glm::max(from, to), glm::dvec3{0.0});
            if (integration.has_hands) {
                low = glm::min(low, with_hands);
                high = glm::max(high, with_hands);
            }
            return glm::min(glm::max(now, low - stray), high + stray);
        };
        const glm::dvec3 velocity =
            kept(way, integration.start.velocity, end.velocity, integration.mean.velocity, aside);
        const glm::dvec3 spin =
            kept(mean.spin, integration.start.spin, end.spin, integration.mean.spin, aside / half);
        if (velocity == way && spin == mean.spin) continue;
        way = velocity;
        if (spin != mean.spin) {
            mean.angular_impulse += Bodies::apply_inertia(
                state.bodies.properties[slot], state.bodies.orientation.at(slot), spin - mean.spin);
            mean.spin = spin;
        }
        solver.response(i) = {};
        ways.any_kept = true;
    }
    return ways;
}

Placement placement_at_end(const BodyIntegration& integration, const Bodies& bodies, Slot slot,
                           const BodyMotion& mean, double tick)
{
    const glm::dquat orientation = orientation_at_end(integration, bodies, slot, mean, tick);
    if (integration.has_hands)
        return {integration.position + tick * (mean.velocity - integration.mean_to_there.velocity),
                orientation};
    return {bodies.position.at(slot) + tick * mean.velocity, orientation};
}

void integrate_position(const BodyIntegration& integration, Bodies& bodies, Slot slot,
                        ContactSolver& solver, const Scales& scales)
{
    const SolverIndex index = slot + 1;
    const BodyMotion& end_motion = solver.end_motion(index);
    const Placement end =
        placement_at_end(integration, bodies, slot, solver.mean_motion(index), scales.tick);
    bodies.orientation.put(slot, end.orientation);
    bodies.position.put(slot, end.position);
    bodies.velocity.put(slot, end_motion.velocity);
    bodies.angular_momentum.put(
        slot, about_unlocked_axes(bodies.properties[slot], integration.angular_momentum +
                                                               end_motion.angular_impulse +
                                                               integration.bounce_angular_impulse));
}

} // namespace hapnet::scene

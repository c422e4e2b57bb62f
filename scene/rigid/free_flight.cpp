// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/free_flight.hpp"

#include "scene/maths/rotation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

/// One coordinate of a parabola.
struct ParabolaStep {
    double tick = 0.0;
    double velocity_change = 0.0;
    double displacement = 0.0;
};

void integrate_axis(std::vector<double>& position, std::vector<double>& velocity, SlotRange range,
                    const ParabolaStep& by)
{
    const ParabolaStep step = by;
    double* const x = position.data();
    double* const v = velocity.data();
    for (std::size_t i = range.begin; i < range.end; ++i) {
        x[i] += v[i] * step.tick + step.displacement;
        v[i] += step.velocity_change;
    }
}

/// The square of half the angle of a turn that is too small to change an orientation.
constexpr double negligible2 = 1e-36;

/// The turns of some bodies, in lanes on the stack. There the compiler knows that the lanes do not
/// overlap, so the loops become vector instructions.
struct Rotations {
    static constexpr std::size_t room = 128;
    std::array<double, room> w, x, y, z;
    std::array<double, room> renewed; // 1: the orientation is made unit; 0: it stays as it is
};

/// Finds the turn of every body of the range. Returns how many turn too far for the short series.
double find_rotations(Rotations& rotations, const Bodies::Lanes3& momentum, SlotRange range,
                      const double* half_angle_by_momentum)
{
    const double* const lx = momentum.x.data() + range.begin;
    const double* const ly = momentum.y.data() + range.begin;
    const double* const lz = momentum.z.data() + range.begin;
    const std::size_t count = range.end - range.begin;
    double far = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double rate = half_angle_by_momentum[i];
        const double x = rate * lx[i];
        const double y = rate * ly[i];
        const double z = rate * lz[i];
        const double square = x * x + y * y + z * z;
        const HalfAngle rotation = small_half_angle(square);
        rotations.w[i] = rotation.cosine;
        rotations.x[i] = rotation.sinc * x;
        rotations.y[i] = rotation.sinc * y;
        rotations.z[i] = rotation.sinc * z;
        rotations.renewed[i] = square > negligible2 ? 1.0 : 0.0;
        far += square <= small_half_angle_max ? 0.0 : 1.0;
    }
    return far;
}

/// As find_rotations(), one by one and for turns of any size.
void find_far_rotations(Rotations& rotations, const Bodies::Lanes3& momentum, SlotRange range,
                        const double* half_angle_by_momentum)
{
    for (Slot slot = range.begin; slot < range.end; ++slot) {
        const std::size_t i = slot - range.begin;
        const glm::dvec3 half = half_angle_by_momentum[i] * momentum.at(slot);
        const glm::dquat rotation = rotation_by(2.0 * half);
        rotations.renewed[i] = glm::dot(half, half) > negligible2 ? 1.0 : 0.0;
        rotations.w[i] = rotation.w;
        rotations.x[i] = rotation.x;
        rotations.y[i] = rotation.y;
        rotations.z[i] = rotation.z;
    }
}

/// Applies the turns: orientation = turn * orientation, with length 1.
void apply(const Rotations& rotations, Bodies::Lanes4& orientation, SlotRange range)
{
    double* const w = orientation.w.data() + range.begin;
    double* const x = orientation.x.data() + range.begin;
    double* const y = orientation.y.data() + range.begin;
    double* const z = orientation.z.data() + range.begin;
    const std::size_t count = range.end - range.begin;
    for (std::size_t i = 0; i < count; ++i) {
        const double a = rotations.w[i] * w[i] - rotations.x[i] * x[i] - rotations.y[i] * y[i] -
                         rotations.z[i] * z[i];
        const double b = rotations.w[i] * x[i] + rotations.x[i] * w[i] + rotations.y[i] * z[i] -
                         rotations.z[i] * y[i];
        const double c = rotations.w[i] * y[i] + rotations.y[i] * w[i] + rotations.z[i] * x[i] -
                         rotations.x[i] * z[i];
        const double d = rotations.w[i] * z[i] + rotations.z[i] * w[i] + rotations.x[i] * y[i] -
                         rotations.y[i] * x[i];
        const double square = a * a + b * b + c * c + d * d;
        // 1 / sqrt(square) to first order about 1. The square differs from 1 only by rounding.
        const double shrink = 1.0 + (0.5 * rotations.renewed[i]) * (1.0 - square);
        w[i] = a * shrink;
        x[i] = b * shrink;
        y[i] = c * shrink;
        z[i] = d * shrink;
    }
}

} // namespace

void integrate_parabola(Bodies& bodies, SlotRange range, const glm::dvec3& acceleration,
                        double tick)
{
    const glm::dvec3 velocity_change = tick * acceleration;
    const glm::dvec3 displacement = (0.5 * tick) * velocity_change;
    integrate_axis(bodies.position.x, bodies.velocity.x, range,
                   {tick, velocity_change.x, displacement.x});
    integrate_axis(bodies.position.y, bodies.velocity.y, range,
                   {tick, velocity_change.y, displacement.y});
    integrate_axis(bodies.position.z, bodies.velocity.z, range,
                   {tick, velocity_change.z, displacement.z});
}

void rotate_uniformly(Bodies& bodies, SlotRange range, double tick)
{
    // Neither is read before it is written; clearing them would cost as much as a body.
    // NOLINTBEGIN(cppcoreguidelines-pro-type-member-init)
    Rotations rotations;
    std::array<double, Rotations::room> rate;
    // NOLINTEND(cppcoreguidelines-pro-type-member-init)
    while (range.begin < range.end) {
        const Slot count = std::min<Slot>(Rotations::room, range.end - range.begin);
        const SlotRange some{range.begin, range.begin + count};
        for (std::size_t i = 0; i < count; ++i)
            rate[i] = (0.5 * tick) * bodies.inverse_inertia_max[some.begin + i];
        if (find_rotations(rotations, bodies.angular_momentum, some, rate.data()) != 0.0)
            find_far_rotations(rotations, bodies.angular_momentum, some, rate.data());
        apply(rotations, bodies.orientation, some);
        range.begin = some.end;
    }
}

bool rotates_uniformly(const BodyProperties& properties)
{
    return properties.turning != Turning::free || properties.is_isotropic;
}

void rotate_freely(Bodies& bodies, Slot slot, double tick)
{
    const BodyProperties& properties = bodies.properties[slot];
    if (properties.turning == Turning::locked) return;
    const glm::dvec3 momentum = bodies.angular_momentum.at(slot);
    if (momentum == glm::dvec3{0.0}) return;
    const glm::dquat now = bodies.orientation.at(slot);
    bodies.orientation.put(slot,
                           rotates_uniformly(properties)
                               ? rotated(now, tick * bodies.apply_inverse_inertia(slot, momentum))
                               : rotated_freely(now, {momentum, properties.inverse_inertia}, tick));
}

glm::dvec3 gravity_on(const BodyProperties& properties, const glm::dvec3& gravity)
{
    return {properties.inverse_mass.x > 0.0 ? gravity.x : 0.0,
            properties.inverse_mass.y > 0.0 ? gravity.y : 0.0,
            properties.inverse_mass.z > 0.0 ? gravity.z : 0.0};
}

FreeBodies::FreeBodies(const WorldConfig& config, const Bodies& bodies)
    : tick_{config.tick}, gravity_{config.gravity}
{
    for (Slot slot = 0; slot < bodies.movable; ++slot) {
        const BodyProperties& properties = bodies.properties[slot];
        const glm::dvec3 acceleration = gravity_on(properties, gravity_);
        if (slot == 0) acceleration_ = acceleration;
        are_alike_ = are_alike_ && rotates_uniformly(properties) && acceleration == acceleration_;
    }
}

void FreeBodies::integrate(Bodies& bodies, SlotRange range) const
{
    if (are_alike_) {
        integrate_parabola(bodies, range, acceleration_, tick_);
        rotate_uniformly(bodies, range, tick_);
        return;
    }
    for (Slot slot = range.begin; slot < range.end; ++slot) {
        integrate_parabola(bodies, {slot, slot + 1}, gravity_on(bodies.properties[slot], gravity_),
                           tick_);
        rotate_freely(bodies, slot, tick_);
    }
}

FreeFlightStepper::FreeFlightStepper(const Description& /*description*/, const WorldConfig& config,
                                     const WorldState& state)
{
    for (Slot slot = 0; slot < state.bodies.movable; ++slot) {
        const BodyProperties& properties = state.bodies.properties[slot];
        const Kind kind = properties.turning == Turning::locked ? Kind::locked
                          : rotates_uniformly(properties)       ? Kind::uniform
                                                                : Kind::tumbling;
        const glm::dvec3 acceleration = gravity_on(properties, config.gravity);
        if (runs_.empty() || runs_.back().kind != kind || runs_.back().acceleration != acceleration)
            runs_.push_back({kind, {slot, slot}, acceleration});
        runs_.back().range.end = slot + 1;
    }
}

void FreeFlightStepper::step(const WorldConfig& config, WorldState& state)
{
    // Half of a torque's impulse acts before the rotation, so the body rotates with the mean over
    // the tick.
    for (const BodyId body : state.twisted) apply_half_torque(state, body, config.tick);
    for (const Run& run : runs_) {
        integrate_parabola(state.bodies, run.range, run.acceleration, config.tick);
        rotate(state.bodies, run, config.tick);
    }
    for (const BodyId body : state.twisted) apply_half_torque(state, body, config.tick);
    for (const BodyId body : state.pushed) apply_push(state, body, config.tick);
}

void FreeFlightStepper::rotate(Bodies& bodies, const Run& run, double tick)
{
    switch (run.kind) {
    case Kind::locked: break;
    case Kind::uniform: rotate_uniformly(bodies, run.range, tick); break;
    case Kind::tumbling:
        for (Slot slot = run.range.begin; slot < run.range.end; ++slot)
            rotate_freely(bodies, slot, tick);
        break;
    }
}

void FreeFlightStepper::apply_push(WorldState& state, BodyId body, double tick)
{
    Bodies& bodies = state.bodies;
    const Slot slot = bodies.slot_of[body];
    const glm::dvec3 change = tick * (bodies.properties[slot].inverse_mass * state.pushes[body]);
    bodies.position.put(slot, bodies.position.at(slot) + (0.5 * tick) * change);
    bodies.velocity.put(slot, bodies.velocity.at(slot) + change);
}

void FreeFlightStepper::apply_half_torque(WorldState& state, BodyId body, double tick)
{
    Bodies& bodies = state.bodies;
    const Slot slot = bodies.slot_of[body];
    const glm::dvec3 change =
        about_unlocked_axes(bodies.properties[slot], 0.5 * tick * state.torques[body]);
    bodies.angular_momentum.put(slot, bodies.angular_momentum.at(slot) + change);
}

void FreeFlightStepper::on_body_placed(WorldState& /*state*/, BodyId /*body*/) {}
void FreeFlightStepper::on_body_shifted(WorldState& /*state*/, BodyId /*body*/) {}

} // namespace hapnet::scene

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
struct Step {
    double tick = 0.0;
    double gained = 0.0; // velocity
    double fallen = 0.0; // displacement
};

void fall_along(std::vector<double>& position, std::vector<double>& velocity, SlotRange range,
                const Step& by)
{
    const Step step = by;
    double* const x = position.data();
    double* const v = velocity.data();
    for (std::size_t i = range.begin; i < range.end; ++i) {
        x[i] += v[i] * step.tick + step.fallen;
        v[i] += step.gained;
    }
}

/// A turn too small to show in an orientation: half its angle, squared.
constexpr double nothing2 = 1e-36;

/// The turns of some bodies, in lanes on the stack: the compiler sees that they overlap nothing,
/// so that the loops become vector instructions.
struct Turns {
    static constexpr std::size_t room = 128;
    std::array<double, room> w, x, y, z;
    std::array<double, room> renewed; // 1: the orientation is made unit; 0: it stays as it is
};

/// The turn of every body of the range. Returns how many turn too far for the short series.
double find_turns(Turns& turns, const Bodies::Lanes3& momentum, SlotRange range,
                  const double* half_turn_by_momentum)
{
    const double* const lx = momentum.x.data() + range.begin;
    const double* const ly = momentum.y.data() + range.begin;
    const double* const lz = momentum.z.data() + range.begin;
    const std::size_t count = range.end - range.begin;
    double far = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double rate = half_turn_by_momentum[i];
        const double x = rate * lx[i];
        const double y = rate * ly[i];
        const double z = rate * lz[i];
        const double square = x * x + y * y + z * z;
        const HalfTurn turn = small_half_turn(square);
        turns.w[i] = turn.cosine;
        turns.x[i] = turn.sinc * x;
        turns.y[i] = turn.sinc * y;
        turns.z[i] = turn.sinc * z;
        turns.renewed[i] = square > nothing2 ? 1.0 : 0.0;
        far += square <= small_turn_max ? 0.0 : 1.0;
    }
    return far;
}

/// As find_turns, one by one and for turns of any size.
void find_far_turns(Turns& turns, const Bodies::Lanes3& momentum, SlotRange range,
                    const double* half_turn_by_momentum)
{
    for (Slot slot = range.begin; slot < range.end; ++slot) {
        const std::size_t i = slot - range.begin;
        const glm::dvec3 half = half_turn_by_momentum[i] * momentum.at(slot);
        const glm::dquat turn = turn_by(2.0 * half);
        turns.renewed[i] = glm::dot(half, half) > nothing2 ? 1.0 : 0.0;
        turns.w[i] = turn.w;
        turns.x[i] = turn.x;
        turns.y[i] = turn.y;
        turns.z[i] = turn.z;
    }
}

/// orientation = turn * orientation, unit.
void apply(const Turns& turns, Bodies::Lanes4& orientation, SlotRange range)
{
    double* const w = orientation.w.data() + range.begin;
    double* const x = orientation.x.data() + range.begin;
    double* const y = orientation.y.data() + range.begin;
    double* const z = orientation.z.data() + range.begin;
    const std::size_t count = range.end - range.begin;
    for (std::size_t i = 0; i < count; ++i) {
        const double a =
            turns.w[i] * w[i] - turns.x[i] * x[i] - turns.y[i] * y[i] - turns.z[i] * z[i];
        const double b =
            turns.w[i] * x[i] + turns.x[i] * w[i] + turns.y[i] * z[i] - turns.z[i] * y[i];
        const double c =
            turns.w[i] * y[i] + turns.y[i] * w[i] + turns.z[i] * x[i] - turns.x[i] * z[i];
        const double d =
            turns.w[i] * z[i] + turns.z[i] * w[i] + turns.x[i] * y[i] - turns.y[i] * x[i];
        const double square = a * a + b * b + c * c + d * d;
        // 1 / sqrt(square) to the first order about 1, from which rounding alone has led it away.
        const double shrink = 1.0 + (0.5 * turns.renewed[i]) * (1.0 - square);
        w[i] = a * shrink;
        x[i] = b * shrink;
        y[i] = c * shrink;
        z[i] = d * shrink;
    }
}

} // namespace

void fall(Bodies& bodies, SlotRange range, const glm::dvec3& acceleration, double tick)
{
    const glm::dvec3 gained = tick * acceleration;
    const glm::dvec3 fallen = (0.5 * tick) * gained;
    fall_along(bodies.position.x, bodies.velocity.x, range, {tick, gained.x, fallen.x});
    fall_along(bodies.position.y, bodies.velocity.y, range, {tick, gained.y, fallen.y});
    fall_along(bodies.position.z, bodies.velocity.z, range, {tick, gained.z, fallen.z});
}

void turn_evenly(Bodies& bodies, SlotRange range, double tick)
{
    // Neither is read before it is written; clearing them would cost as much as a body.
    // NOLINTBEGIN(cppcoreguidelines-pro-type-member-init)
    Turns turns;
    std::array<double, Turns::room> rate;
    // NOLINTEND(cppcoreguidelines-pro-type-member-init)
    while (range.begin < range.end) {
        const Slot count = std::min<Slot>(Turns::room, range.end - range.begin);
        const SlotRange some{range.begin, range.begin + count};
        for (std::size_t i = 0; i < count; ++i)
            rate[i] = (0.5 * tick) * bodies.ease[some.begin + i];
        if (find_turns(turns, bodies.angular_momentum, some, rate.data()) != 0.0)
            find_far_turns(turns, bodies.angular_momentum, some, rate.data());
        apply(turns, bodies.orientation, some);
        range.begin = some.end;
    }
}

bool turns_evenly(const BodyForm& form)
{
    return form.turning != Turning::free || form.is_isotropic;
}

void turn_freely(Bodies& bodies, Slot slot, double tick)
{
    const BodyForm& form = bodies.form[slot];
    if (form.turning == Turning::locked) return;
    const glm::dvec3 momentum = bodies.angular_momentum.at(slot);
    if (momentum == glm::dvec3{0.0}) return;
    const glm::dquat now = bodies.orientation.at(slot);
    bodies.orientation.put(slot, turns_evenly(form)
                                     ? turned(now, tick * bodies.turned_by(slot, momentum))
                                     : spun(now, {momentum, form.inverse_inertia}, tick));
}

glm::dvec3 falling(const BodyForm& form, const glm::dvec3& gravity)
{
    return {form.inverse_mass.x > 0.0 ? gravity.x : 0.0,
            form.inverse_mass.y > 0.0 ? gravity.y : 0.0,
            form.inverse_mass.z > 0.0 ? gravity.z : 0.0};
}

Fliers::Fliers(const WorldConfig& config, const Bodies& bodies)
    : tick_{config.tick}, gravity_{config.gravity}
{
    for (Slot slot = 0; slot < bodies.movable; ++slot) {
        const BodyForm& form = bodies.form[slot];
        const glm::dvec3 acceleration = falling(form, gravity_);
        if (slot == 0) acceleration_ = acceleration;
        are_alike_ = are_alike_ && turns_evenly(form) && acceleration == acceleration_;
    }
}

void Fliers::move(Bodies& bodies, SlotRange range) const
{
    if (are_alike_) {
        fall(bodies, range, acceleration_, tick_);
        turn_evenly(bodies, range, tick_);
        return;
    }
    for (Slot slot = range.begin; slot < range.end; ++slot) {
        fall(bodies, {slot, slot + 1}, falling(bodies.form[slot], gravity_), tick_);
        turn_freely(bodies, slot, tick_);
    }
}

FreeFlightStepper::FreeFlightStepper(const Description& /*description*/, const WorldConfig& config,
                                     const WorldState& state)
{
    for (Slot slot = 0; slot < state.bodies.movable; ++slot) {
        const BodyForm& form = state.bodies.form[slot];
        const Kind kind = form.turning == Turning::locked ? Kind::locked
                          : turns_evenly(form)            ? Kind::even
                                                          : Kind::wobbling;
        const glm::dvec3 acceleration = falling(form, config.gravity);
        if (runs_.empty() || runs_.back().kind != kind || runs_.back().acceleration != acceleration)
            runs_.push_back({kind, {slot, slot}, acceleration});
        runs_.back().range.end = slot + 1;
    }
}

void FreeFlightStepper::step(const WorldConfig& config, WorldState& state)
{
    Bodies& bodies = state.bodies;
    const double tick = config.tick;
    for (const Run& run : runs_) {
        fall(bodies, run.range, run.acceleration, tick);
        switch (run.kind) {
        case Kind::locked: break;
        case Kind::even: turn_evenly(bodies, run.range, tick); break;
        case Kind::wobbling:
            for (Slot slot = run.range.begin; slot < run.range.end; ++slot)
                turn_freely(bodies, slot, tick);
            break;
        }
    }
    for (const BodyId id : state.pushed) {
        const Slot slot = bodies.slot_of[id];
        const glm::dvec3 gained = tick * (bodies.form[slot].inverse_mass * state.pushes[id]);
        bodies.position.put(slot, bodies.position.at(slot) + (0.5 * tick) * gained);
        bodies.velocity.put(slot, bodies.velocity.at(slot) + gained);
    }
}

void FreeFlightStepper::on_body_placed(WorldState& /*state*/, BodyId /*body*/) {}

} // namespace hapnet::scene

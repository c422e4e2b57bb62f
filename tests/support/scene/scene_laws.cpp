// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/scene/scene_laws.hpp"

#include "proto/base/random.hpp"
#include "tests/support/scene/dice.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::test {

namespace {

using scene::BodyDescription;
using scene::BodyId;
using scene::BodyState;
using scene::Turning;
using scene::World;

// Of the energy that is there.
constexpr double energy_tolerance = 1e-6;
// Of the sum of all momenta and impulses.
constexpr double momentum_tolerance = 1e-10;
constexpr double force_tolerance = 1e-6; // of a direction held while it turns
constexpr double unit_tolerance = 1e-12;
// Of the smallest half edge in a tick: what crosses so little is at rest.
constexpr double speed_scale = 1e-6;
// Radians in a tick beyond which a body's inertia is not what it was: then no energy of turning
// within what its angular momentum allows is too much.
constexpr double far_turn = 0.25;
// How many movable bodies one hand may push.
constexpr double touched_max = 8.0;

double length(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

bool is_finite(const BodyState& state)
{
    const glm::dquat& q = state.orientation;
    return base::is_finite(state.position) && base::is_finite(state.velocity) &&
           base::is_finite(state.angular_velocity) && std::isfinite(q.w + q.x + q.y + q.z);
}

bool is_finite(const scene::HandTouch& touch)
{
    return base::is_finite(touch.on_body) && base::is_finite(touch.on_hand) &&
           base::is_finite(touch.on_hand_at_start) && std::isfinite(touch.depth_m);
}

bool is_same(const BodyState& a, const BodyState& b)
{
    return a.position == b.position && a.orientation == b.orientation;
}

bool keeps_locks(const BodyDescription& form, const BodyState& before, const BodyState& after)
{
    if (form.locked.x && before.position.x() != after.position.x()) return false;
    if (form.locked.y && before.position.y() != after.position.y()) return false;
    if (form.locked.z && before.position.z() != after.position.z()) return false;
    if (form.turning == Turning::free) return true;
    if (form.turning == Turning::locked) return before.orientation == after.orientation;
    const glm::dquat by = after.orientation * glm::conjugate(before.orientation);
    const double x = form.turning == Turning::about_x ? 0.0 : std::abs(by.x);
    const double y = form.turning == Turning::about_y ? 0.0 : std::abs(by.y);
    const double z = form.turning == Turning::about_z ? 0.0 : std::abs(by.z);
    return x + y + z <= unit_tolerance;
}

glm::dvec3 free_part(const BodyDescription& form, glm::dvec3 v)
{
    if (form.locked.x) v.x = 0.0;
    if (form.locked.y) v.y = 0.0;
    if (form.locked.z) v.z = 0.0;
    return v;
}

/// Of turning with an angular momentum, with the inertia of an orientation.
double spinning_energy(const BodyDescription& form, const glm::dquat& orientation,
                       const glm::dvec3& momentum)
{
    const glm::dvec3 inertia = scene::box_inertia(form.mass_kg, form.half);
    switch (form.turning) {
    case Turning::locked: return 0.0;
    case Turning::free: {
        const glm::dvec3 own = glm::conjugate(orientation) * momentum;
        return 0.5 * glm::dot(own, own / inertia);
    }
    default: break;
    }
    // About one axis of the world, which is the same axis of the body's: see BodyProperties.
    const int axis = static_cast<int>(form.turning) - static_cast<int>(Turning::about_x);
    return 0.5 * momentum[axis] * momentum[axis] / inertia[axis];
}

/// The energy that a hand can have given to one body: what its spring stored at the tick's start
/// and the work of its own motion; of one that holds, what its force can do.
double most_from_hand(const World& world, std::uint32_t hand, double fastest)
{
    const scene::HandDescription& hands = world.frozen().hands;
    const scene::HandTouch& touch = world.touch(hand);
    const double impulse = world.frozen().tick * base::norm(touch.on_body);
    constexpr double within = 2.0; // the body may be faster within the tick than at its ends
    if (touch.holding) return within * impulse * fastest;
    const double bend = hands.force_max_n / hands.stiffness_n_per_m;
    const double stored = touch.depth_m < bend
                              ? 0.5 * hands.stiffness_n_per_m * touch.depth_m * touch.depth_m
                              : hands.force_max_n * (touch.depth_m - 0.5 * bend);
    return std::max(stored, 0.0) + impulse * base::norm(world.state().hands[hand].velocity);
}

/// By how much the energy of turning with one angular momentum can differ with the orientation.
double spinning_range(const BodyDescription& form, const glm::dvec3& momentum)
{
    if (form.turning != Turning::free) return 0.0;
    const glm::dvec3 inertia = scene::box_inertia(form.mass_kg, form.half);
    const double least = std::min({inertia.x, inertia.y, inertia.z});
    const double most = std::max({inertia.x, inertia.y, inertia.z});
    return 0.5 * glm::dot(momentum, momentum) * (1.0 / least - 1.0 / most);
}

} // namespace

SceneLaws::SceneLaws(const RandomPlay& play) : play_{play}, moments_(play.description.bodies.size())
{
    nothing_is_fixed_ = play.description.planes.empty();
    for (const BodyDescription& form : play.description.bodies) {
        size_ = std::min({size_, form.half.x, form.half.y, form.half.z});
        if (form.movable) movable_ += 1.0;
        const bool locked = form.locked.x || form.locked.y || form.locked.z;
        if (!form.movable || locked) nothing_is_fixed_ = false;
    }
    for (const scene::JointDescription& joint : play.description.joints)
        if (!joint.to) nothing_is_fixed_ = false;
}

/// From where the bodies are: a hinge's angle is the world's, which counts its turns.
double SceneLaws::stored_by(const World& world) const
{
    double sum = 0.0;
    const auto& joints = play_.description.joints;
    for (scene::JointId id = 0; id < joints.size(); ++id) {
        const scene::JointDescription& joint = joints[id];
        const bool is_spring = joint.kind == scene::JointKind::spring;
        const double slack =
            is_spring ? length(joint.position.value - joint.to_position.value) : 0.0;
        const double bend = world.joint(id).coordinate - joint.rest.value_or(slack);
        sum += 0.5 * joint.stiffness * bend * bend;
    }
    return sum;
}

SceneLaws::Moment SceneLaws::moment_of(const World& world, BodyId id) const
{
    const scene::Bodies& bodies = world.state().bodies;
    return {world.body(id), bodies.angular_momentum.at(bodies.slot_of[id]), world.is_awake(id)};
}

void SceneLaws::before(const World& world)
{
    for (BodyId id = 0; id < moments_.size(); ++id) moments_[id] = moment_of(world, id);
    stored_ = stored_by(world);
}

std::optional<std::string> SceneLaws::after(const World& world)
{
    if (auto complaint = check_hands(world)) return complaint;
    Balance balance;
    for (BodyId id = 0; id < moments_.size(); ++id) {
        if (auto complaint = check_body(world, id)) return complaint;
        if (play_.description.bodies[id].movable) add(balance, world, id);
    }
    if (auto complaint = check_energy(world, balance)) return complaint;
    if (auto complaint = check_ways(world, balance)) return complaint;
    return check_momentum(world, balance);
}

std::optional<std::string> SceneLaws::check_body(const World& world, BodyId id) const
{
    const BodyDescription& form = play_.description.bodies[id];
    const BodyState& was = moments_[id].state;
    const Moment now = moment_of(world, id);
    if (!is_finite(now.state)) return fmt::format("body {} is not finite", id);
    const glm::dquat& q = now.state.orientation;
    if (std::abs(glm::dot(q, q) - 1.0) > unit_tolerance)
        return fmt::format("body {}: its orientation is not unit", id);
    if (!form.movable && !is_same(now.state, was)) return fmt::format("body {} is fixed", id);
    if (!form.movable) return std::nullopt;
    if (!keeps_locks(form, was, now.state)) return fmt::format("body {} left its locks", id);
    if (now.is_awake) return std::nullopt;
    if (length(now.state.velocity.value) != 0.0 || length(now.angular_momentum) != 0.0)
        return fmt::format("body {} moves and sleeps", id);
    if (!moments_[id].is_awake && !is_same(now.state, was))
        return fmt::format("body {} moved in its sleep", id);
    return std::nullopt;
}

std::optional<std::string> SceneLaws::check_hands(const World& world)
{
    const double most = play_.description.hands.force_max_n;
    for (std::uint32_t i = 0; i < play_.description.hands.count; ++i) {
        const scene::HandTouch& touch = world.touch(i);
        if (!is_finite(touch)) return fmt::format("hand {}: what it feels is not finite", i);
        if (!(most > 0.0) || std::isinf(most)) continue;
        const double force = base::norm(touch.on_body);
        worst_.force = std::max(worst_.force, force / most);
        if (force > most * (1.0 + force_tolerance))
            return fmt::format("hand {} pushes with {} N of {} N", i, force, most);
    }
    return std::nullopt;
}

/// Gravity and pushes. The world forgets pushes at the tick's end; they are the play's.
glm::dvec3 SceneLaws::steady_force(const World& world, BodyId id, bool sleeps) const
{
    const BodyDescription& form = play_.description.bodies[id];
    glm::dvec3 force{0.0};
    if (!sleeps) force = free_part(form, form.mass_kg * play_.description.gravity);
    for (const auto& [body, push] : play_.ticks[world.ticks() - 1].pushes) {
        if (body == id) force += free_part(form, push.value);
    }
    return force;
}

/// By how much the energy of a body that turns may be wrong.
double SceneLaws::turning_slack(const BodyDescription& form, const Moment& was, const Moment& now,
                                double angle)
{
    // The spin changes while the angular momentum stays: in the impulses of contacts it counts.
    const glm::dvec3 inertia = scene::box_inertia(form.mass_kg, form.half);
    const double wobble =
        std::max({inertia.x, inertia.y, inertia.z}) / std::min({inertia.x, inertia.y, inertia.z}) -
        1.0;
    const double spin =
        std::max(length(was.state.angular_velocity), length(now.state.angular_velocity));
    const double slack =
        wobble * angle * spin * length(now.angular_momentum - was.angular_momentum);
    if (angle <= far_turn) return slack;
    return slack + spinning_range(form, was.angular_momentum) +
           spinning_range(form, now.angular_momentum);
}

void SceneLaws::add(Balance& balance, const World& world, BodyId id) const
{
    const BodyDescription& form = play_.description.bodies[id];
    const Moment& was = moments_[id];
    const Moment now = moment_of(world, id);
    const double tick = world.frozen().tick;
    const glm::dvec3& v0 = was.state.velocity.value;
    const glm::dvec3& v1 = now.state.velocity.value;
    const glm::dvec3 moved = now.state.position.value - was.state.position.value;
    const glm::dvec3 steady = 0.5 * tick * (v0 + v1);
    const double mass = form.mass_kg;
    const bool sleeps = !was.is_awake && !now.is_awake;
    const glm::dvec3 force = steady_force(world, id, sleeps);
    const glm::dquat& rotated = was.state.orientation;
    balance.kinetic_before +=
        0.5 * mass * glm::dot(v0, v0) + spinning_energy(form, rotated, was.angular_momentum);
    balance.kinetic_after +=
        0.5 * mass * glm::dot(v1, v1) + spinning_energy(form, rotated, now.angular_momentum);
    balance.work += std::max(glm::dot(force, steady), glm::dot(force, moved));
    const double radius = length(form.half);
    const double spin =
        std::max(length(was.state.angular_velocity), length(now.state.angular_velocity));
    balance.fastest =
        std::max({balance.fastest, length(v0) + spin * radius, length(v1) + spin * radius});
    balance.farthest = std::max(balance.farthest, length(moved) - radius);
    balance.jolt += mass * length(v1 - v0);
    balance.momentum += mass * (length(v0) + length(v1)) + tick * length(force);
    balance.slack += turning_slack(form, was, now, spin * tick);
    const double reach = length(now.state.position.value) + length(was.state.position.value);
    balance.angular += mass * reach * (length(v0) + length(v1)) + length(now.angular_momentum) +
                       length(was.angular_momentum) + tick * reach * length(force);
    balance.astray += mass * length(moved - steady) * (length(v0) + length(v1));
    // The solver may stop, after its last sweep, short of its goal by about what the forces add in
    // a tick; and knows no speeds below its own scale.
    constexpr double miss = 2.0;
    const double scale = speed_scale * size_ / tick;
    balance.slack +=
        miss * miss * tick * tick * glm::dot(force, force) / mass + mass * scale * scale;
    balance.linear_gain += mass * (v1 - v0) - tick * force;
    balance.angular_gain += mass * (glm::cross(now.state.position.value, v1) -
                                    glm::cross(was.state.position.value, v0)) +
                            now.angular_momentum - was.angular_momentum -
                            tick * glm::cross(was.state.position.value + 0.5 * steady, force);
    if (was.is_awake && !now.is_awake) balance.any_fell_asleep = true;
}

std::optional<std::string> SceneLaws::check_energy(const World& world, const Balance& balance)
{
    double hands = 0.0;
    for (std::uint32_t i = 0; i < play_.description.hands.count; ++i)
        hands += std::min(touched_max, movable_) * most_from_hand(world, i, balance.fastest);
    const double stored = stored_by(world);
    const double gained =
        balance.kinetic_after - balance.kinetic_before + stored - stored_ - balance.work - hands;
    const double there =
        balance.kinetic_before + balance.kinetic_after + std::abs(balance.work) + stored + stored_;
    const double tolerated = energy_tolerance * there + balance.slack;
    if (tolerated > 0.0) worst_.energy = std::max(worst_.energy, gained / tolerated);
    if (gained <= tolerated) return std::nullopt;
    return fmt::format("{} J came from nowhere; there were {} J", gained, balance.kinetic_before);
}

std::optional<std::string> SceneLaws::check_ways(const World& world, const Balance& balance) const
{
    // What slides is put out of what it is in at once.
    if (world.stepper_kind() <= scene::StepperKind::sliding_coulomb) return std::nullopt;
    for (std::uint32_t i = 0; i < play_.description.hands.count; ++i) {
        if (world.touch(i).touching) return std::nullopt;
    }
    constexpr double cornerwise = 2.0;
    const double most = cornerwise * world.frozen().tick * balance.fastest;
    if (balance.farthest <= most) return std::nullopt;
    return fmt::format("a body went {} m, the fastest could go {} m", balance.farthest, most);
}

std::optional<std::string> SceneLaws::check_momentum(const World& world, const Balance& balance)
{
    if (!nothing_is_fixed_ || balance.any_fell_asleep) return std::nullopt;
    const double tick = world.frozen().tick;
    glm::dvec3 hands{0.0};
    bool any_hand = false;
    for (std::uint32_t i = 0; i < play_.description.hands.count; ++i) {
        hands -= tick * world.touch(i).on_hand.value;
        any_hand = any_hand || world.touch(i).touching;
    }
    const double miss = length(balance.linear_gain - hands);
    const double tolerated = momentum_tolerance * (balance.momentum + length(hands));
    if (tolerated > 0.0) worst_.momentum = std::max(worst_.momentum, miss / tolerated);
    if (miss > tolerated)
        return fmt::format("{} N s of {} came from nowhere", miss, balance.momentum);
    if (any_hand) return std::nullopt;
    for (const BodyDescription& form : play_.description.bodies) {
        if (form.turning != Turning::free) return std::nullopt;
    }
    // Impulses act at points held for the tick, during which those that push each other pass.
    const double rotated = length(balance.angular_gain);
    const double allowed = momentum_tolerance * balance.angular + balance.astray +
                           tick * balance.jolt * balance.fastest;
    if (allowed > 0.0)
        worst_.angular_momentum = std::max(worst_.angular_momentum, rotated / allowed);
    if (rotated <= allowed) return std::nullopt;
    return fmt::format("{} N m s came from nowhere; {} tolerated", rotated, allowed);
}

PlayOutcome judge(const RandomPlay& play, std::uint64_t seed)
{
    PlayOutcome outcome;
    auto frozen = World::freeze(play.description, play.options);
    if (!frozen) {
        outcome.complaint = frozen.error().message;
        return outcome;
    }
    World& world = *frozen;
    SceneLaws laws{play};
    Dice dice{base::Seed{seed}.stream("snapshot")};
    const std::uint64_t from = dice.below(play.ticks.size());
    std::optional<World::Snapshot> snapshot;
    for (const TickInputs& inputs : play.ticks) {
        if (world.ticks() == from) snapshot = world.snapshot();
        feed(world, inputs);
        laws.before(world);
        world.tick();
        if (const auto complaint = laws.after(world)) {
            outcome.complaint = fmt::format("tick {}: {}", world.ticks(), *complaint);
            outcome.worst = laws.worst();
            outcome.interventions = world.state().interventions;
            return outcome;
        }
    }
    outcome.worst = laws.worst();
    outcome.interventions = world.state().interventions;
    outcome.hash = world.hash();
    const std::uint64_t end = world.ticks();
    world.restore(*snapshot);
    while (world.ticks() < end) {
        feed(world, play.ticks[world.ticks()]);
        world.tick();
    }
    if (world.hash() != outcome.hash)
        outcome.complaint = fmt::format("another future after a snapshot at tick {}", from);
    return outcome;
}

} // namespace hapnet::test

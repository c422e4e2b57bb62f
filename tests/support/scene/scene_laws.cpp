// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/scene/scene_laws.hpp"

#include "proto/base/math.hpp"
#include "proto/base/random.hpp"
#include "scene/fields.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/query.hpp"
#include "tests/support/scene/dice.hpp"
#include "tests/support/scene/spinning.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::test {

namespace {

using scene::BodyDescription;
using scene::BodyId;
using scene::BodyState;
using scene::Turning;
using scene::World;

// Relative to the present energy.
constexpr double energy_tolerance = 1e-6;
// Relative to the sum of all momenta and impulses.
constexpr double momentum_tolerance = 1e-10;
// Relative to the sizes of the hands' reports. They may cancel each other, and a sum of them has no
// more digits than its largest part.
constexpr double report_rounding = 4.0 * std::numeric_limits<double>::epsilon();
constexpr double force_tolerance = 1e-6; // for a direction held while it turns
constexpr double unit_tolerance = 1e-12;
// In smallest half edges per tick: a slower body is at rest.
constexpr double speed_scale = 1e-6;
// Radians in a tick beyond which a body's inertia is not what it was: then no energy of turning
// within what its angular momentum allows is too much.
constexpr double far_turn = 0.25;
// The number of movable bodies that one hand may push.
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

/// The largest energy that a grip can have given to its body: the work of its largest force.
double most_from_grip(const World& world, std::uint32_t hand, double fastest)
{
    const double impulse = world.frozen().tick * base::norm(world.touch(hand).on_body);
    constexpr double within = 2.0; // the body may be faster within the tick than at its ends
    return within * impulse * fastest;
}

/// The largest energy that a hand can have given to one body that it pushes: the energy stored in
/// its springs at the tick's start, for this number of contacts, and the work of its own motion.
double most_from_push(const World& world, std::uint32_t hand, double contacts)
{
    scene::HandDescription hands = world.frozen().hands;
    const scene::HandFeels& feels = world.frozen().feels;
    for (BodyId id = 0; id < world.state().bodies.size(); ++id) {
        hands.stiffness_n_per_m = std::max(
            hands.stiffness_n_per_m, feels.of(hand, id, world.frozen().hands).stiffness_n_per_m);
    }
    const scene::HandTouch& touch = world.touch(hand);
    const double impulse = world.frozen().tick * base::norm(touch.on_body);
    const double bend = hands.force_max_n / hands.stiffness_n_per_m;
    const double stored = touch.depth_m < bend
                              ? 0.5 * hands.stiffness_n_per_m * touch.depth_m * touch.depth_m
                              : hands.force_max_n * (touch.depth_m - 0.5 * bend);
    const double along = world.state().slips.empty() ? 0.0 : world.state().slips[hand].stored_j;
    return contacts * std::max(stored, 0.0) + along +
           impulse * base::norm(world.state().hands[hand].velocity);
}

/// The largest distance of a corner from the centre of mass.
double radius_of(const BodyDescription& form)
{
    return length(form.parts.empty() ? form.half : scene::half_around(scene::parts_of(form)));
}

double least_half(const BodyDescription& form)
{
    double least = std::min({form.half.x, form.half.y, form.half.z});
    for (const scene::PartDescription& part : form.parts)
        least = std::min({least, part.half.x, part.half.y, part.half.z});
    return least;
}

} // namespace

SceneLaws::SceneLaws(const RandomPlay& play) : play_{play}, moments_(play.description.bodies.size())
{
    nothing_is_fixed_ = play.description.planes.empty();
    for (const BodyDescription& form : play.description.bodies) {
        size_ = std::min(size_, least_half(form));
        if (form.movable) movable_ += 1.0;
        const bool locked = form.locked.x || form.locked.y || form.locked.z;
        if (!form.movable || locked) nothing_is_fixed_ = false;
    }
}

SceneLaws::Moment SceneLaws::moment_of(const World& world, BodyId id) const
{
    const scene::Bodies& bodies = world.state().bodies;
    return {world.body(id), bodies.angular_momentum.at(bodies.slot_of[id]), world.is_awake(id)};
}

void SceneLaws::before(const World& world)
{
    touches_before_ = world.state().interventions.sweeps_continued;
    const scene::Bodies& bodies = world.state().bodies;
    for (BodyId id = 0; id < moments_.size(); ++id) {
        moments_[id] = moment_of(world, id);
        if (!play_.description.bodies[id].movable) continue;
        for (const scene::FieldDescription& field : world.frozen().fields)
            moments_[id].field += force_on_body(field, world.frozen(), bodies, bodies.slot_of[id]);
    }
}

std::optional<std::string> SceneLaws::after(const World& world)
{
    if (auto complaint = check_hands(world)) return complaint;
    Balance balance;
    for (BodyId id = 0; id < moments_.size(); ++id) {
        if (auto complaint = check_body(world, id)) return complaint;
        if (play_.description.bodies[id].movable) add(balance, world, id);
        if (play_.description.bodies[id].kinematic) add_driven(balance, world, id);
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
    if (!form.movable && !form.kinematic && !is_same(now.state, was))
        return fmt::format("body {} is fixed", id);
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
        const double force = base::norm(touch.on_body) / contacts_on(touch);
        worst_.force = std::max(worst_.force, force / most);
        if (force > most * (1.0 + force_tolerance))
            return fmt::format("hand {} pushes with {} N of {} N", i, force, most);
    }
    return std::nullopt;
}

/// Returns gravity and the play's pushes, because the world clears pushes at the tick's end.
glm::dvec3 SceneLaws::steady_force(const World& world, BodyId id, bool sleeps) const
{
    const BodyDescription& form = play_.description.bodies[id];
    glm::dvec3 force{0.0};
    if (!sleeps) force = free_part(form, form.mass_kg * play_.description.gravity);
    for (const auto& [body, push] : play_.ticks[world.ticks() - 1].pushes) {
        if (body == id) force += free_part(form, push.value);
    }
    for (const Twist& twist : play_.ticks[world.ticks() - 1].twists) {
        if (twist.body == id && is_in_reach(moments_[id].state.position.value, twist))
            force += free_part(form, twist.force);
    }
    return force + free_part(form, moments_[id].field);
}

glm::dvec3 SceneLaws::steady_torque(const World& world, BodyId id) const
{
    glm::dvec3 torque{0.0};
    for (const Twist& twist : play_.ticks[world.ticks() - 1].twists) {
        if (twist.body == id && is_in_reach(moments_[id].state.position.value, twist))
            torque += twist.torque + glm::cross(twist.at, twist.force);
    }
    const Turning turning = play_.description.bodies[id].turning;
    if (turning == Turning::free) return torque;
    glm::dvec3 about{0.0};
    if (turning == Turning::about_x) about.x = torque.x;
    if (turning == Turning::about_y) about.y = torque.y;
    if (turning == Turning::about_z) about.z = torque.z;
    return about;
}

void SceneLaws::add_driven(Balance& balance, const World& world, BodyId id) const
{
    const BodyState& was = moments_[id].state;
    const BodyState now = world.body(id);
    const double radius = radius_of(play_.description.bodies[id]);
    const glm::dvec3 moved = (now.position.value - was.position.value) / world.frozen().tick;
    // The rotation of the tick, for a body that is moved to a place.
    const glm::dquat by = now.orientation * glm::conjugate(was.orientation);
    const double turned = 2.0 * length({by.x, by.y, by.z}) / world.frozen().tick;
    const double spin =
        std::max({length(was.angular_velocity), length(now.angular_velocity), turned});
    const double speed =
        std::max({length(was.velocity.value), length(now.velocity.value), length(moved)});
    balance.driven = std::max(balance.driven, speed + spin * radius);
    balance.fastest = std::max(balance.fastest, speed + spin * radius);
}

/// Returns the error of the energy of a rotating body.
double SceneLaws::turning_slack(const BodyDescription& form, const Moment& was, const Moment& now,
                                double angle)
{
    // The spin changes while the angular momentum stays, which matters for contact impulses.
    const glm::dvec3 inertia = scene::inertia_of(form);
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

/// The work of a torque that is held for the tick: over the mean of the spins, with the inertia as
/// it is before it or as it becomes, or over the angle that the body really turned, where that is
/// less than half a turn; and, as with forces, what it adds to the spin twice.
void SceneLaws::add_torque(Balance& balance, const BodyDescription& form, const Moment& was,
                           const Moment& now, const glm::dvec3& torque) const
{
    const double tick = base::to_seconds(play_.options.tick);
    const glm::dvec3 twist = tick * torque;
    const auto spin_of = [&](const glm::dvec3& momentum) {
        const glm::dvec3 inertia = scene::inertia_of(form);
        if (form.turning != Turning::free) return momentum / inertia_about_axes(form);
        return was.state.orientation *
               ((glm::conjugate(was.state.orientation) * momentum) / inertia);
    };
    const double held =
        0.5 * glm::dot(twist, spin_of(was.angular_momentum) + spin_of(now.angular_momentum));
    const double went =
        0.5 * glm::dot(twist, was.state.angular_velocity + now.state.angular_velocity);
    const double over_turn =
        glm::dot(torque, scene::turn_between(was.state.orientation, now.state.orientation));
    const double fastest =
        std::max(length(was.state.angular_velocity), length(now.state.angular_velocity));
    const bool is_followed = tick * fastest < 0.5 * base::two_pi;
    balance.work += std::max({held, went, is_followed ? over_turn : held});
    constexpr double miss = 2.0;
    balance.slack += miss * miss * glm::dot(twist, spin_of(twist));
    balance.angular += length(twist);
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
    const double spinning = spinning_energy(form, rotated, now.angular_momentum);
    balance.kinetic_after += 0.5 * mass * glm::dot(v1, v1) + spinning;
    balance.work += std::max(glm::dot(force, steady), glm::dot(force, moved));
    const glm::dvec3 torque = steady_torque(world, id);
    if (torque != glm::dvec3{0.0}) add_torque(balance, form, was, now, torque);
    const double least = least_half(form);
    balance.passed += length(mass * (v1 - v0) - tick * force) +
                      length(now.angular_momentum - was.angular_momentum - tick * torque) / least;
    const double radius = radius_of(form);
    const double spin =
        std::max(length(was.state.angular_velocity), length(now.state.angular_velocity));
    balance.fastest =
        std::max({balance.fastest, length(v0) + spin * radius, length(v1) + spin * radius});
    const double beyond = length(moved) - radius;
    balance.farthest = std::max(balance.farthest, beyond);
    if (beyond > 0.0) balance.fling = std::max(balance.fling, 0.5 * mass * beyond * beyond);
    // A field may press bodies together that hardly change their velocities, and what it drives
    // may be faster within the tick than at its end, where something stops it.
    const glm::dvec3 by_field = tick * free_part(form, was.field);
    balance.jolt += std::max(mass * length(v1 - v0), length(mass * (v1 - v0) - by_field));
    balance.hurry = std::max(balance.hurry, length(by_field) / mass);
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
                            now.angular_momentum - was.angular_momentum - tick * torque -
                            tick * glm::cross(was.state.position.value + 0.5 * steady, force);
    if (was.is_awake && !now.is_awake) balance.any_fell_asleep = true;
}

/// The energy that a hand can have given to all bodies. One that holds a body also pushes the
/// others that it reaches.
double SceneLaws::most_from_hand(const World& world, std::uint32_t hand, double fastest) const
{
    double contacts = 1.0;
    for (const BodyDescription& form : play_.description.bodies)
        contacts = std::max(contacts, 1.0 + static_cast<double>(form.parts.size()));
    if (!world.touch(hand).holding)
        return std::min(touched_max, movable_) * most_from_push(world, hand, contacts);
    // The body that it holds may be far away.
    const double others = std::min({touched_max, movable_ - 1.0, within_reach(world, hand)});
    return most_from_grip(world, hand, fastest) + others * most_from_push(world, hand, contacts);
}

/// The largest number of movable bodies that touched a hand in the tick.
double SceneLaws::within_reach(const World& world, std::uint32_t hand) const
{
    const scene::HandInput& input = world.state().hands[hand];
    const double gone = world.frozen().tick * base::norm(input.velocity);
    double count = 0.0;
    for (BodyId id = 0; id < moments_.size(); ++id) {
        const BodyDescription& form = play_.description.bodies[id];
        if (!form.movable) continue;
        const glm::dvec3& was = moments_[id].state.position.value;
        const double moved = length(world.position(id).value - was);
        const double reach = world.frozen().hands.radius_m + radius_of(form) + gone + moved;
        if (length(was - input.position.value) <= reach) count += 1.0;
    }
    return count;
}

/// The energy that kinematic bodies can have given: by each contact its impulse, with friction, at
/// the speed of the surface or at that of the body, whichever is less. Impulses that fast bodies
/// exchanged within the tick are in no contact, but in the bodies' momentum.
double SceneLaws::driven_energy(const World& world, const Balance& balance) const
{
    if (balance.driven == 0.0) return 0.0;
    const std::vector<BodyDescription>& forms = play_.description.bodies;
    std::vector<scene::Contact> room((forms.size() + 1) * (forms.size() + 1));
    room.resize(std::min(contacts(world, room), room.size()));
    double sum = balance.driven * balance.passed;
    for (const scene::Contact& contact : room) {
        if (contact.other.kind == scene::Thing::Kind::plane) continue;
        const BodyId other = contact.other.index;
        if (!forms[contact.body].kinematic && !forms[other].kinematic) continue;
        const BodyId body = forms[contact.body].kinematic ? other : contact.body;
        if (!forms[body].movable) continue;
        const BodyState& was = moments_[body].state;
        const BodyState now = world.body(body);
        const double mean =
            0.5 * (length(was.velocity.value + now.velocity.value) +
                   radius_of(forms[body]) * length(was.angular_velocity + now.angular_velocity));
        const double friction =
            combined(forms[contact.body].material, forms[other].material).friction;
        sum += (1.0 + friction) * contact.normal_impulse * std::min(balance.driven, mean);
    }
    return sum;
}

std::optional<std::string> SceneLaws::check_energy(const World& world, const Balance& balance)
{
    double hands = 0.0;
    for (std::uint32_t i = 0; i < play_.description.hands.count; ++i)
        hands += most_from_hand(world, i, balance.fastest);
    const double driven = driven_energy(world, balance);
    const double gained =
        balance.kinetic_after - balance.kinetic_before - balance.work - hands - driven;
    const double there = balance.kinetic_before + balance.kinetic_after + std::abs(balance.work);
    const double tolerated = energy_tolerance * there + balance.slack;
    if (tolerated > 0.0) worst_.energy = std::max(worst_.energy, gained / tolerated);
    if (gained <= tolerated) return std::nullopt;
    return fmt::format("{} J came from nowhere; there were {} J", gained, balance.kinetic_before);
}

std::optional<std::string> SceneLaws::check_ways(const World& world, const Balance& balance) const
{
    // A sliding body that overlaps something is moved out of it at once.
    if (world.stepper_kind() <= scene::StepperKind::sliding_coulomb) return std::nullopt;
    for (std::uint32_t i = 0; i < play_.description.hands.count; ++i) {
        if (world.touch(i).touching) return std::nullopt;
    }
    constexpr double cornerwise = 2.0;
    const double most = cornerwise * world.frozen().tick * (balance.fastest + balance.hurry);
    if (balance.farthest <= most) return std::nullopt;
    // Between two touches in the tick a body may be faster than at its ends: a light one that heavy
    // ones throw to each other. Then it is as fast as the energy that there is can make it.
    const double tick = world.frozen().tick;
    const double there = balance.kinetic_before + std::max(balance.work, 0.0) + balance.slack;
    if (world.state().interventions.sweeps_continued > touches_before_ + 1 &&
        balance.fling <= there * tick * tick)
        return std::nullopt;
    return fmt::format("a body went {} m, the fastest could go {} m", balance.farthest, most);
}

std::optional<std::string> SceneLaws::check_momentum(const World& world, const Balance& balance)
{
    if (!nothing_is_fixed_ || balance.any_fell_asleep) return std::nullopt;
    // The force of a field on a hand acts on no body.
    for (const scene::FieldDescription& field : play_.description.fields) {
        if (field.on_hands) return std::nullopt;
    }
    const double tick = world.frozen().tick;
    glm::dvec3 hands{0.0};
    double reported = 0.0;
    bool any_hand = false;
    for (std::uint32_t i = 0; i < play_.description.hands.count; ++i) {
        hands -= tick * world.touch(i).on_hand.value;
        reported += tick * base::norm(world.touch(i).on_hand);
        any_hand = any_hand || world.touch(i).touching;
    }
    const double miss = length(balance.linear_gain - hands);
    const double tolerated =
        momentum_tolerance * (balance.momentum + length(hands)) + report_rounding * reported;
    if (tolerated > 0.0) worst_.momentum = std::max(worst_.momentum, miss / tolerated);
    if (miss > tolerated)
        return fmt::format("{} N s of {} came from nowhere", miss, balance.momentum);
    if (any_hand) return std::nullopt;
    for (const BodyDescription& form : play_.description.bodies) {
        if (form.turning != Turning::free) return std::nullopt;
    }
    // Impulses act at points held for the tick, during which touching bodies move past each other.
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

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/scene/random_play.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"
#include "proto/base/random.hpp"
#include "scene/maths/vector.hpp"
#include "tests/support/scene/dice.hpp"
#include "tests/support/scene/random_elements.hpp"
#include "tests/support/scene/random_hands.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

namespace hapnet::test {

namespace {

using scene::BodyDescription;
using scene::Description;
using scene::Turning;

enum class Layout : std::uint8_t { loose, row, stack, heap };

/// The common properties of a scene's bodies.
struct Style {
    double size = 0.02; // m
    double mass = 0.1;  // kg
    bool alike = false;
    bool aligned = false; // nothing is turned
    bool locks = false;
    bool spins = false;
    Layout layout = Layout::loose;
    double speed = 0.0;
    std::uint64_t turning = 0; // of Turning; beyond: mixed
    bool smooth = false;
    bool bounces = false;
    bool drags = false;
};

Style random_style(Dice& dice)
{
    Style style;
    style.size = dice.one_in(4) ? dice.power(1e-3, 1.0) : 0.02;
    style.mass = dice.one_in(3) ? dice.power(1e-3, 10.0) : 0.1;
    style.alike = dice.one_in(2);
    style.aligned = dice.one_in(2);
    style.locks = dice.one_in(6);
    style.spins = dice.one_in(3);
    style.layout = static_cast<Layout>(dice.below(4));
    constexpr std::array<double, 6> speeds{0.0, 0.0, 0.1, 1.0, 10.0, 1000.0};
    const double speed = speeds[dice.below(speeds.size())];
    style.speed = speed * (dice.one_in(2) ? 1.0 : dice.share());
    style.turning = dice.one_in(2) ? 0 : dice.below(6);
    style.smooth = dice.one_in(3);
    style.bounces = dice.one_in(3);
    style.drags = dice.one_in(4);
    return style;
}

scene::Material random_material(Dice& dice, const Style& style)
{
    scene::Material material;
    if (!style.smooth) material.friction = dice.one_in(2) ? 0.3 : dice.between(0.0, 1.5);
    if (style.bounces) material.restitution = dice.one_in(4) ? 1.0 : dice.share();
    return material;
}

/// A quaternion that turns as far as `turning` lets it.
glm::dquat random_orientation(Dice& dice, Turning turning)
{
    if (turning >= Turning::about_x) {
        glm::dquat turn{dice.sign(), 0.0, 0.0, 0.0};
        const double part = dice.sign();
        if (turning == Turning::about_x) turn.x = part;
        if (turning == Turning::about_y) turn.y = part;
        if (turning == Turning::about_z) turn.z = part;
        return base::normalized(turn);
    }
    return base::normalized({dice.sign(), dice.sign(), dice.sign(), 1.0});
}

glm::dvec3 place_in_layout(Dice& dice, const Style& style, std::size_t index)
{
    const double cell = 2.0 * style.size;
    const double i = static_cast<double>(index);
    switch (style.layout) {
    case Layout::row: return {cell * i, 0.0, 0.0};
    case Layout::stack: return {0.0, cell * i, 0.0};
    case Layout::heap: return 1.5 * cell * dice.vector();
    case Layout::loose: break;
    }
    const double apart = 4.0 * style.size;
    const std::array<double, 3> at{static_cast<double>(index % 4),
                                   static_cast<double>(index / 4 % 4),
                                   static_cast<double>(index / 16)};
    return glm::dvec3{apart * at[0], apart * at[1], apart * at[2]} +
           0.25 * style.size * dice.vector();
}

BodyDescription random_body(Dice& dice, const Style& style, std::size_t index)
{
    BodyDescription body;
    body.movable = index == 0 || !dice.one_in(8);
    body.half = glm::dvec3{style.size};
    body.mass_kg = style.mass;
    if (!style.alike) {
        for (const int axis : {0, 1, 2}) body.half[axis] *= dice.between(0.3, 1.0);
        body.mass_kg *= dice.one_in(2) ? dice.power(1e-2, 1e2) : dice.power(0.03, 33.0);
    }
    const std::uint64_t turning = style.turning < 5 ? style.turning : dice.below(5);
    body.turning = static_cast<Turning>(turning);
    if (!style.aligned) body.orientation = random_orientation(dice, body.turning);
    body.position.value = place_in_layout(dice, style, index);
    body.velocity.value = style.speed * dice.vector();
    if (style.spins) body.angular_velocity = dice.vector_of_power(0.1, 100.0);
    if (style.locks) {
        body.locked.x = dice.one_in(3);
        body.locked.y = dice.one_in(3);
        body.locked.z = dice.one_in(3);
    }
    body.material = random_material(dice, style);
    if (style.drags) body.drag_ns_per_m = dice.power(0.1, 30.0);
    return body;
}

/// Adds a floor below the lowest corners, and sometimes walls.
void add_planes(Dice& dice, const Style& style, Description& drawn)
{
    if (dice.one_in(4)) return;
    const double deep = style.layout == Layout::heap ? dice.between(-1.0, 3.0) : 1.0;
    const double reach = style.aligned ? style.size : 1.75 * style.size;
    drawn.planes.push_back({"floor", {0.0, 1.0, 0.0}, -deep * reach, random_material(dice, style)});
    for (auto walls = dice.below(3); walls > 0; --walls) {
        glm::dvec3 normal{1.0, 0.0, 0.0};
        if (!style.aligned) {
            normal = dice.vector();
            normal /= std::sqrt(glm::dot(normal, normal));
        }
        double least = std::numeric_limits<double>::infinity();
        for (const BodyDescription& body : drawn.bodies)
            least = std::min(least, glm::dot(normal, body.position.value));
        drawn.planes.push_back(
            {"wall", normal, least - 2.0 * style.size, random_material(dice, style)});
    }
}

scene::HandDescription random_hips(Dice& dice, const Style& style, double tick)
{
    scene::HandDescription hands;
    hands.count = dice.one_in(5) ? static_cast<std::uint32_t>(dice.below(scene::hands_max + 1)) : 2;
    hands.radius_m = style.size * dice.between(0.1, 0.5);
    const double stiffness = dice.power(0.01, 1000.0) * style.mass / (tick * tick);
    hands.stiffness_n_per_m = std::min(stiffness, scene::stiffness_max_n_per_m);
    if (!dice.one_in(3)) {
        const double critical = 2.0 * std::sqrt(hands.stiffness_n_per_m * style.mass);
        hands.damping_ns_per_m =
            std::min(dice.power(0.001, 2.0) * critical, scene::damping_max_ns_per_m);
    }
    const double weight = 10.0 * style.mass;
    hands.force_max_n =
        dice.one_in(3) ? std::numeric_limits<double>::infinity() : weight * dice.power(0.1, 100.0);
    hands.grip_reach_m = style.size * dice.share();
    return hands;
}

Description random_description(Dice& dice, const PlayLimits& limits, double tick, bool& overlaps)
{
    Style style = random_style(dice);
    Description drawn;
    // Many scenes are small: one body, or a few.
    const std::uint64_t most = dice.one_in(3) ? limits.bodies_max : 1 + dice.below(10);
    const std::uint64_t bodies = 1 + dice.below(std::min<std::uint64_t>(most, limits.bodies_max));
    for (std::size_t i = 0; i < bodies; ++i) drawn.bodies.push_back(random_body(dice, style, i));
    if (dice.one_in(4)) { // one that moves among fixed ones
        for (std::size_t i = 1; i < bodies; ++i) drawn.bodies[i].movable = false;
        if (style.aligned && dice.one_in(2)) drawn.bodies[0].turning = Turning::locked;
    }
    add_planes(dice, style, drawn);
    drawn.hands = random_hips(dice, style, tick);
    if (dice.one_in(4)) drawn.gravity = dice.one_in(2) ? glm::dvec3{0.0} : 20.0 * dice.vector();
    overlaps = style.layout == Layout::heap || !style.aligned;
    return drawn;
}

/// Turns some bodies into spheres and capsules, if these fit inside them.
void make_round(std::uint64_t seed, Description& drawn)
{
    Dice dice{base::Seed{seed}.stream("round")};
    const std::uint64_t how = dice.below(4); // mixed, all of them, spheres, capsules
    for (BodyDescription& body : drawn.bodies) {
        if (how == 0 && dice.one_in(2)) continue;
        const bool is_sphere = how == 2 || (how != 3 && dice.one_in(2));
        const double least = std::min({body.half.x, body.half.y, body.half.z});
        if (is_sphere) {
            body.shape = scene::Shape::sphere;
            body.half = glm::dvec3{least};
            continue;
        }
        const double longest = std::max({body.half.x, body.half.y, body.half.z});
        const auto axis = static_cast<int>(dice.below(3));
        body.shape = scene::Shape::capsule;
        body.half = glm::dvec3{std::max(least * dice.between(0.2, 0.9), scene::size_min_m)};
        body.half[axis] = dice.one_in(2) ? longest : least;
    }
}

/// Adds further parts to some bodies, which begin anywhere near the first part.
void add_parts(std::uint64_t seed, Description& drawn)
{
    Dice dice{base::Seed{seed}.stream("parts")};
    const bool any_round = dice.one_in(3), is_aligned = dice.one_in(2);
    for (BodyDescription& body : drawn.bodies) {
        if (dice.one_in(3)) continue;
        for (auto left = 1 + dice.below(3); left > 0; --left) {
            scene::PartDescription part;
            for (const int axis : {0, 1, 2})
                part.half[axis] =
                    std::max(body.half[axis] * dice.between(0.2, 1.0), scene::size_min_m);
            if (any_round && dice.one_in(2)) {
                part.shape = scene::Shape::sphere;
                part.half = glm::dvec3{part.half.x};
            }
            part.position.value = 1.5 * body.half * dice.vector();
            if (!is_aligned) part.orientation = random_orientation(dice, Turning::free);
            body.parts.push_back(part);
        }
    }
}

} // namespace

RandomPlay random_play(std::uint64_t seed, const PlayLimits& limits)
{
    Dice dice{base::Seed{seed}.stream("scene")};
    RandomPlay play;
    constexpr std::array<int, 7> ticks_us{1000, 1000, 1000, 1000, 250, 500, 4000};
    play.options.tick = std::chrono::microseconds{ticks_us[dice.below(ticks_us.size())]};
    play.options.sleeping = !dice.one_in(4);
    play.description =
        random_description(dice, limits, base::to_seconds(play.options.tick), play.overlaps);
    if (seed >= elements_from)
        add_elements(seed, play);
    else if (seed >= round_plays_from)
        make_round(seed, play.description);
    if (limits.compounds) {
        add_parts(seed, play.description);
        play.overlaps = true;
    }
    const auto needed =
        scene::required_features(scene::requirements_of(play.description, play.options.sleeping));
    if (dice.one_in(3)) { // any profile that can play it
        const auto any = static_cast<scene::StepperKind>(dice.below(scene::stepper_kinds));
        if (scene::abilities_of(any).covers(needed)) play.options.stepper = any;
    }
    const auto length = static_cast<std::uint32_t>(
        limits.ticks_min + dice.below(limits.ticks_max - limits.ticks_min + 1));
    play.ticks = random_inputs(seed, play, length);
    if (seed >= elements_from) add_actions(seed, play);
    return play;
}

bool is_in_reach(const glm::dvec3& position, const Twist& twist)
{
    return scene::is_within(position + twist.at, scene::reach_max_m);
}

void feed(scene::World& world, const TickInputs& inputs)
{
    for (std::uint32_t i = 0; i < inputs.hands.size(); ++i)
        base::ensure(!world.set_hand(i, inputs.hands[i]));
    for (const auto& [body, force] : inputs.pushes) base::ensure(!world.push(body, force));
    for (const auto& [body, state] : inputs.places) base::ensure(!world.place(body, state));
    for (const Twist& twist : inputs.twists) {
        const base::Position at{world.position(twist.body).value + twist.at};
        if (!is_in_reach(world.position(twist.body).value, twist)) continue;
        base::ensure(!world.push(twist.body, base::Force{twist.force}, at));
        base::ensure(!world.push_torque(twist.body, twist.torque));
    }
    for (const Blow& blow : inputs.blows) {
        const base::Position at{world.position(blow.body).value + blow.at};
        std::ignore = world.apply_impulse(blow.body, blow.impulse, at);
    }
    for (const Drive& drive : inputs.drives) {
        if (!drive.is_way) {
            base::ensure(!world.drive(drive.body, base::Velocity{drive.velocity}, drive.spin));
            continue;
        }
        const double tick = world.frozen().tick;
        scene::BodyState target = world.body(drive.body);
        target.position.value += tick * drive.velocity;
        const glm::dvec3 half_turn = (0.5 * tick) * drive.spin;
        target.orientation = base::normalized(
            glm::dquat{1.0, half_turn.x, half_turn.y, half_turn.z} * target.orientation);
        target.velocity.value = drive.velocity;
        target.angular_velocity = drive.spin;
        base::ensure(!world.move(drive.body, target));
    }
}

} // namespace hapnet::test

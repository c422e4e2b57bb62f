// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/scene/random_elements.hpp"

#include "proto/base/random.hpp"
#include "tests/support/scene/dice.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::test {

namespace {

using scene::BodyDescription;
using scene::Description;

void make_kinematic(Dice& dice, BodyDescription& body, double size)
{
    body.movable = false;
    body.kinematic = true;
    const double speed = dice.one_in(10) ? 100.0 : dice.power(0.01, 3.0);
    if (dice.one_in(3)) {
        body.velocity = {};
        const glm::dvec3 direction = dice.vector();
        body.sway.by = size * dice.between(0.1, 3.0) * direction;
        body.sway.period = base::Duration{static_cast<std::int64_t>(
            dice.between(static_cast<double>(scene::period_min.count()), 1e9))};
    } else {
        body.velocity.value = speed * dice.vector();
    }
    body.angular_velocity = glm::dvec3{0.0};
    if (dice.one_in(2)) body.angular_velocity = dice.vector_of_power(0.1, 30.0);
}

scene::Feel random_feel(Dice& dice, const Description& scene, bool any_friction)
{
    scene::Feel feel;
    const scene::HandDescription& hands = scene.hands;
    if (dice.one_in(3)) {
        feel.stiffness_n_per_m = std::min(hands.stiffness_n_per_m * dice.power(0.01, 100.0),
                                          scene::stiffness_max_n_per_m);
    }
    if (dice.one_in(3)) {
        feel.damping_ns_per_m =
            std::min(hands.damping_ns_per_m * dice.power(0.01, 10.0), scene::damping_max_ns_per_m);
    }
    if (any_friction && dice.one_in(2)) feel.static_friction = dice.between(0.0, 2.0);
    if (feel.static_friction && dice.one_in(2))
        feel.dynamic_friction = *feel.static_friction * dice.share();
    return feel;
}

scene::FieldDescription random_field(Dice& dice, const Description& scene, double tick)
{
    const BodyDescription& near_it = scene.bodies[dice.below(scene.bodies.size())];
    const double size = scene.bodies[0].half.x;
    const double mass = scene.bodies[0].mass_kg;
    scene::FieldDescription field{.name = "field"};
    field.position.value = near_it.position.value + 2.0 * size * dice.vector();
    if (dice.one_in(2)) field.half = size * glm::dvec3{dice.between(1.0, 20.0)};
    if (dice.one_in(2)) {
        const glm::dvec3 direction = dice.vector();
        field.force.value = mass * dice.power(0.1, 1e2) * direction;
    }
    if (dice.one_in(2)) {
        const double damping = mass / tick * dice.power(1e-4, 1e2);
        field.damping_ns_per_m = std::min(damping, scene::damping_max_ns_per_m);
    }
    if (dice.one_in(2)) {
        const double stiffness = mass / (tick * tick) * dice.power(1e-5, 1e2);
        field.stiffness_n_per_m = std::min(stiffness, scene::stiffness_max_n_per_m);
    }
    if (dice.one_in(3)) {
        const glm::dvec3 along = dice.vector();
        field.line = along / std::sqrt(glm::dot(along, along));
    }
    if (dice.one_in(2)) field.force_limit_n = mass * dice.power(1.0, 1e3);
    field.on_bodies = !dice.one_in(4);
    field.on_hands = dice.one_in(2);
    return field;
}

} // namespace

void add_elements(std::uint64_t seed, RandomPlay& play)
{
    Dice dice{base::Seed{seed}.stream("elements")};
    Description& scene = play.description;
    const double tick = base::to_seconds(play.options.tick);
    const double size = scene.bodies[0].half.x;
    if (dice.one_in(2)) {
        for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
            BodyDescription& body = scene.bodies[i];
            if (dice.one_in(body.movable ? 8 : 2)) make_kinematic(dice, body, size);
        }
    }
    const bool any_friction = dice.one_in(2);
    if (any_friction) {
        scene.hands.static_friction = dice.between(0.0, 2.0);
        if (dice.one_in(2))
            scene.hands.dynamic_friction = scene.hands.static_friction * dice.share();
    }
    for (scene::PlaneDescription& plane : scene.planes) plane.felt = dice.one_in(3);
    if (dice.one_in(2)) {
        for (BodyDescription& body : scene.bodies) {
            if (dice.one_in(3)) body.feel = random_feel(dice, scene, any_friction);
        }
        for (std::uint32_t i = 0; i < scene.hands.count; ++i)
            scene.own_hands.push_back(random_feel(dice, scene, any_friction));
    }
    if (!dice.one_in(3)) return;
    for (auto left = 1 + dice.below(3); left > 0; --left)
        scene.fields.push_back(random_field(dice, scene, tick));
}

void add_actions(std::uint64_t seed, RandomPlay& play)
{
    Dice dice{base::Seed{seed}.stream("actions")};
    const Description& scene = play.description;
    const bool twists = dice.one_in(3), drives = dice.one_in(2);
    for (TickInputs& now : play.ticks) {
        const auto body = static_cast<scene::BodyId>(dice.below(scene.bodies.size()));
        const BodyDescription& form = scene.bodies[body];
        if (form.kinematic && drives && dice.one_in(3)) {
            const double speed = dice.one_in(20) ? 100.0 : dice.power(0.01, 3.0);
            const double spin = dice.power(0.1, 30.0);
            const bool is_way = dice.one_in(2);
            now.drives.push_back({body, speed * dice.vector(), spin * dice.vector(), is_way});
        }
        if (!form.movable || !twists || !dice.one_in(4)) continue;
        const double most = std::max({form.half.x, form.half.y, form.half.z});
        const double force = form.mass_kg * dice.power(0.1, 1e3);
        const glm::dvec3 at = form.half * dice.vector();
        if (dice.one_in(3)) {
            now.blows.push_back({body, 1e-2 * force * dice.vector(), at});
        } else {
            const double torque = dice.one_in(2) ? most * force : 0.0;
            now.twists.push_back({body, force * dice.vector(), at, torque * dice.vector()});
        }
    }
}

} // namespace hapnet::test

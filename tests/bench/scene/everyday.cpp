// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Everyday scenes that are no engine's best case.
#include "scene/mass.hpp"
#include "tests/bench/scene/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::bench {

namespace {

constexpr double fall_rate = 9.81; // m/s^2

scene::BodyDescription ball_at(double x)
{
    scene::BodyDescription body = cube();
    body.shape = scene::Shape::sphere;
    body.position.value.x = x;
    return body;
}

double energy_of(const scene::BodyDescription& form, const scene::BodyState& state)
{
    const glm::dvec3 own = glm::conjugate(state.orientation) * state.angular_velocity;
    const glm::dvec3& v = state.velocity.value;
    return 0.5 * form.mass_kg * glm::dot(v, v) + 0.5 * glm::dot(scene::inertia_of(form) * own, own);
}

/// A ball that rolls over ten boxes that lie flush: its speed is that on one slab.
Scenario seams()
{
    constexpr double speed = 0.5, edge = 0.1;
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.gravity = {0.0, -fall_rate, 0.0};
    scene.bodies = {ball_at(0.0)};
    scene.bodies[0].velocity = {{speed, 0.0, 0.0}};
    scene.bodies[0].angular_velocity = {0.0, 0.0, -speed / scene.bodies[0].half.x};
    for (int i = 0; i < 10; ++i) {
        scene::BodyDescription tile = cube();
        tile.movable = false;
        tile.half = glm::dvec3{0.5 * edge};
        tile.position.value = {edge * i, -0.5 * edge - scene.bodies[0].half.x, 0.0};
        scene.bodies.push_back(tile);
    }
    Scenario scenario{"n seams: a ball rolls over flush boxes", "analytic", {scene, 1.5, {}}, {}};
    scenario.measure = [](Engine& engine, const Course& course, double tick_s) {
        run(engine, course, tick_s);
        const glm::dvec3 expected{speed * course.duration_s, 0.0, 0.0};
        const double missed = glm::length(engine.state(0).position.value - expected);
        return std::vector<Measure>{{"error_m", missed, {}}};
    };
    return scenario;
}

/// Five elastic balls that touch, and a sixth that hits them: the last leaves with its speed.
Scenario cradle()
{
    constexpr double speed = 1.0;
    scene::Description scene = lone_cube(scene::Turning::free);
    const double across = 2.0 * cube().half.x;
    scene.bodies = {ball_at(4.0 * across)};
    for (int i = 0; i < 4; ++i) scene.bodies.push_back(ball_at(i * across));
    scene.bodies.push_back(ball_at(-across - 0.05));
    scene.bodies.back().velocity = {{speed, 0.0, 0.0}};
    for (scene::BodyDescription& body : scene.bodies) body.material = {0.0, 1.0};
    Scenario scenario{"n cradle of five balls that touch", "analytic", {scene, 0.2, {}}, {}};
    scenario.measure = [](Engine& engine, const Course& course, double tick_s) {
        run(engine, course, tick_s);
        const double missed = std::abs(engine.state(0).velocity.x() / speed - 1.0);
        return std::vector<Measure>{{"relative_speed_error", missed, 1e-9}};
    };
    return scenario;
}

/// Four small parts fall into a tray. Measures the most energy that they gain, and that they fell.
Scenario tray()
{
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.gravity = {0.0, -fall_rate, 0.0};
    scene.bodies.clear();
    const scene::Material material{0.3, 0.6};
    for (int i = 0; i < 4; ++i) {
        scene::BodyDescription part = cube();
        part.half = {0.01, 0.004, 0.002};
        part.mass_kg = 0.005;
        part.material = material;
        part.position.value = {0.015 * (i % 2) - 0.0075, 0.35 + 0.03 * i, 0.004 * i};
        part.orientation = even_turn(i, 4);
        part.angular_velocity = {5.0, -3.0, 2.0 * i};
        part.velocity = {{0.0, -1.0, 0.0}};
        scene.bodies.push_back(part);
    }
    const auto wall = [&](const glm::dvec3& half, const glm::dvec3& at) {
        scene::BodyDescription body = cube();
        body.movable = false;
        body.half = half;
        body.position.value = at;
        body.material = material;
        scene.bodies.push_back(body);
    };
    wall({0.1, 0.01, 0.1}, {0.0, -0.01, 0.0});
    for (const double side : {-1.0, 1.0}) {
        wall({0.01, 0.1, 0.1}, {0.06 * side, 0.1, 0.0});
        wall({0.1, 0.1, 0.01}, {0.0, 0.1, 0.06 * side});
    }
    Scenario scenario{"n tray: four parts of 20 mm fall in", "analytic", {scene, 1.0, {}}, {}};
    scenario.measure = [](Engine& engine, const Course& course, double tick_s) {
        const auto energy = [&] {
            double sum = 0.0;
            for (scene::BodyId id = 0; id < 4; ++id) {
                const scene::BodyDescription& form = course.scene.bodies[id];
                const scene::BodyState state = engine.state(id);
                sum += energy_of(form, state) + form.mass_kg * fall_rate * state.position.y();
            }
            return sum;
        };
        const double start = energy();
        double most = 0.0;
        run(engine, course, tick_s, [&](double) { most = std::max(most, energy() / start - 1.0); });
        double highest = 0.0;
        for (scene::BodyId id = 0; id < 4; ++id)
            highest = std::max(highest, engine.state(id).position.y());
        return std::vector<Measure>{{"relative_energy_gain", most, 1e-4},
                                    {"highest_at_end_m", highest, 0.1}};
    };
    return scenario;
}

/// A hand pushes a rough cube beside its middle, so that it rotates while it slides on its plane.
/// Measures how far the cube leaves the plane, and how far it is behind the hand.
Scenario off_centre_push_with_friction()
{
    constexpr double speed = 0.05, aside = 0.008;
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.gravity = {0.0, -fall_rate, 0.0};
    scene.planes = {platform()};
    scene.hands = {
        .stiffness_n_per_m = 500.0, .damping_ns_per_m = 2.0, .force_max_n = 1e6, .count = 1};
    Scenario scenario{"n off-centre push with friction", "analytic", {scene, 0.4, {}}, {}};
    const double reach = cube().half.x + scene.hands.radius_m;
    scenario.course.hands = [reach](std::uint32_t, double time_s) {
        return scene::HandInput{{{-reach + speed * time_s, 0.0, aside}}, {{speed, 0.0, 0.0}}};
    };
    scenario.measure = [](Engine& engine, const Course& course, double tick_s) {
        run(engine, course, tick_s);
        const scene::BodyState end = engine.state(0);
        return std::vector<Measure>{
            {"lift_m", std::abs(end.position.y()), 1e-9},
            {"behind_m", speed * course.duration_s - end.position.x(), 0.01}};
    };
    return scenario;
}

} // namespace

std::vector<Scenario> everyday_scenarios()
{
    return {seams(), cradle(), tray(), off_centre_push_with_friction()};
}

} // namespace hapnet::bench

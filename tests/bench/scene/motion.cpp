// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// A cube alone: it flies, slides, tumbles, or is pushed beside its centre.
#include "tests/bench/scene/reference.hpp"
#include "tests/bench/scene/scenario.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

scene::BodyDescription cube()
{
    scene::BodyDescription cube{.name = "cube"};
    cube.material.friction = 0.3;
    return cube;
}

scene::PlaneDescription platform()
{
    scene::PlaneDescription plane{.name = "platform", .offset_m = -0.02};
    plane.material.friction = 0.3;
    return plane;
}

glm::dquat even_turn(int i, int count)
{
    // Super-Fibonacci spirals: Alexa, CVPR 2022.
    constexpr double phi = std::numbers::sqrt2, psi = 1.533751168755204288118041;
    const double s = i + 0.5, share = s / count, angle = 2.0 * std::numbers::pi * s;
    const double inner = std::sqrt(share), outer = std::sqrt(1.0 - share);
    return {outer * std::cos(angle / psi), inner * std::sin(angle / phi),
            inner * std::cos(angle / phi), outer * std::sin(angle / psi)};
}

scene::Description lone_cube(scene::Turning turning)
{
    scene::Description scene{.name = "lone cube"};
    scene.bodies = {cube()};
    scene.bodies[0].turning = turning;
    scene.gravity = glm::dvec3{0.0};
    scene.hands.count = 0;
    return scene;
}

Scenario ballistic()
{
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.gravity = {0.0, -9.81, 0.0};
    scene.bodies[0].velocity = {{0.3, 2.0, 0.1}};
    Scenario scenario{"a ballistic 1 s", "analytic", {scene, 1.0, {}}, {}};
    scenario.measure = [](Engine& engine, const Course& course, double tick_s) {
        run(engine, course, tick_s);
        const double t = course.duration_s;
        const glm::dvec3 expected =
            t * course.scene.bodies[0].velocity.value + 0.5 * t * t * course.scene.gravity;
        return std::vector<Measure>{
            {"error_m", glm::length(engine.state(0).position.value - expected), 1e-12}};
    };
    scenario.is_flight = true;
    return scenario;
}

Scenario slide(double degrees, scene::Turning turning)
{
    constexpr double speed = 0.5, deceleration = 0.3 * 9.81;
    scene::Description scene = lone_cube(turning);
    scene.gravity = {0.0, -9.81, 0.0};
    scene.planes = {platform()};
    const glm::dvec3 way{std::cos(glm::radians(degrees)), 0.0, std::sin(glm::radians(degrees))};
    scene.bodies[0].velocity = {speed * way};
    const std::string name = fmt::format("b slide {:g} deg{}", degrees,
                                         turning == scene::Turning::locked ? ", locked" : "");
    Scenario scenario{name, "analytic", {scene, 0.2, {}}, {}};
    scenario.measure = [way](Engine& engine, const Course& course, double tick_s) {
        run(engine, course, tick_s);
        constexpr double distance = speed * speed / (2.0 * deceleration);
        const scene::BodyState end = engine.state(0);
        const double rotated = angle_between(course.scene.bodies[0].orientation, end.orientation);
        return std::vector<Measure>{
            {"relative_distance_error", glm::length(end.position.value / distance - way), 1e-9},
            {"turned_rad", rotated, 1e-9}};
    };
    return scenario;
}

Scenario tumble()
{
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.bodies[0].half = {0.01, 0.02, 0.04};
    scene.bodies[0].angular_velocity = {0.01, 10.0, 0.01}; // about the middle axis: it flips
    Scenario scenario{"g Dzhanibekov", "rk4", {scene, 20.0, {}}, {}};
    Course first = scenario.course;
    first.duration_s = 2.0;
    scenario.measure = [first, reference = reference_end(first).orientation](
                           Engine& engine, const Course& course, double tick_s) {
        const scene::BodyDescription& body = course.scene.bodies[0];
        const scene::BodyState start = engine.state(0);
        run(engine, first, tick_s);
        const double error = angle_between(engine.state(0).orientation, reference);
        Course rest = course;
        rest.duration_s = course.duration_s - first.duration_s;
        run(engine, rest, tick_s);
        const scene::BodyState end = engine.state(0);
        const double energy = kinetic_energy(body, end) / kinetic_energy(body, start) - 1.0;
        const double momentum =
            glm::length(angular_momentum(body, end)) / glm::length(angular_momentum(body, start)) -
            1.0;
        return std::vector<Measure>{{"orientation_error_2s_rad", error, 5e-4},
                                    {"relative_energy_drift_20s", std::abs(energy), {}},
                                    {"relative_momentum_drift_20s", std::abs(momentum), 1e-13}};
    };
    scenario.cost_ns_max = 150.0;
    scenario.is_flight = true;
    return scenario;
}

Scenario off_centre_push()
{
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.bodies[0].velocity = {{-0.1, 0.0, 0.0}};
    scene.hands = {
        .stiffness_n_per_m = 1000.0, .damping_ns_per_m = 0.0, .force_max_n = 1e6, .count = 1};
    Scenario scenario{"h off-centre push", "rk4", {scene, 0.05, {}}, {}};
    scenario.course.hands = [](std::uint32_t, double) {
        return scene::HandInput{{{-0.0251, 0.006, 0.004}}, {}};
    };
    scenario.measure = [reference = reference_end(scenario.course)](
                           Engine& engine, const Course& course, double tick_s) {
        run(engine, course, tick_s);
        const scene::BodyState end = engine.state(0);
        return std::vector<Measure>{
            {"error_m", glm::length(end.position.value - reference.position.value), {}},
            {"error_rad", angle_between(end.orientation, reference.orientation), {}}};
    };
    return scenario;
}

} // namespace hapnet::bench

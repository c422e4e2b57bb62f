// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Hands that press and push a cube.
#include "tests/bench/scene/reference.hpp"
#include "tests/bench/scene/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

constexpr double reach = 0.025; // from a cube's centre to a hand's that just touches it

double sign_of(std::uint32_t hand) { return hand == 0 ? -1.0 : 1.0; }

/// Two resting hands that press a cube at the origin to this depth.
std::function<scene::HandInput(std::uint32_t, double)> squeeze(double left_m, double right_m)
{
    return [left_m, right_m](std::uint32_t hand, double) {
        const double depth = hand == 0 ? left_m : right_m;
        return scene::HandInput{{{sign_of(hand) * (reach - depth), 0.0, 0.0}}, {}};
    };
}

scene::HandDescription springs(double stiffness, double damping, std::uint32_t count)
{
    return {.stiffness_n_per_m = stiffness,
            .damping_ns_per_m = damping,
            .force_max_n = 1e6,
            .count = count};
}

std::string with(std::string name, scene::Turning turning)
{
    return turning == scene::Turning::locked ? name + ", locked" : name;
}

} // namespace

Scenario bounce(double stiffness_n_per_m, double offset_m, scene::Turning turning, double gap_m)
{
    scene::Description scene = lone_cube(turning);
    scene.bodies[0].velocity = {{-0.1, 0.0, 0.0}};
    scene.hands = springs(stiffness_n_per_m, 0.0, 1);
    const char* const name =
        offset_m == 0.0 ? "c1 bounce on a hand" : "c1 bounce on a hand, off-centre";
    Scenario scenario{with(name, turning), "analytic", {scene, 0.05, {}}, {}};
    scenario.course.hands = [offset_m, gap_m](std::uint32_t, double) {
        return scene::HandInput{{{-reach - gap_m, offset_m, 0.0}}, {}};
    };
    scenario.measure = [offset_m](Engine& engine, const Course& course, double tick_s) {
        const scene::BodyDescription& body = course.scene.bodies[0];
        const double before = kinetic_energy(body, engine.state(0));
        run(engine, course, tick_s);
        const double after = kinetic_energy(body, engine.state(0));
        const bool has_bounced = engine.state(0).velocity.x() > 0.0;
        const double error = has_bounced ? std::abs(after / before - 1.0) : 1.0;
        return std::vector<Measure>{
            {"relative_energy_error", error, offset_m == 0.0 ? 1e-9 : 1e-4}};
    };
    scenario.has_native = true;
    return scenario;
}

Scenario steady_push(scene::Turning turning)
{
    constexpr double speed = 0.05, settled_s = 3.0, stiffness = 500.0;
    constexpr double expected = 0.3 * 0.1 * 9.81; // the friction that it pushes against, N
    scene::Description scene = lone_cube(turning);
    scene.gravity = {0.0, -9.81, 0.0};
    scene.planes = {platform()};
    scene.hands = springs(stiffness, 2.0, 1);
    Scenario scenario{with("c2 steady push", turning), "analytic", {scene, 3.5, {}}, {}};
    const auto hand_x = [](double time_s) { return -reach + speed * time_s; };
    scenario.course.hands = [hand_x](std::uint32_t, double time_s) {
        return scene::HandInput{{{hand_x(time_s), 0.0, 0.0}}, {{speed, 0.0, 0.0}}};
    };
    scenario.measure = [hand_x](Engine& engine, const Course& course, double tick_s) {
        double low = 1e9, high = -1e9, error = 0.0, lag = 0.0;
        run(engine, course, tick_s, [&](double time_s) {
            if (time_s < settled_s) return;
            const double force = engine.hip_force(0).x;
            low = std::min(low, force);
            high = std::max(high, force);
            error = std::max(error, std::abs(force / expected - 1.0));
            const double depth = hand_x(time_s) + reach - engine.state(0).position.x();
            lag = std::max(lag, std::abs(depth - expected / stiffness));
        });
        return std::vector<Measure>{{"relative_force_error", error, 1e-9},
                                    {"relative_force_ripple", (high - low) / expected, 1e-6},
                                    {"lag_m", lag, 1e-9}};
    };
    scenario.has_native = true;
    return scenario;
}

Scenario steady_push_on_own_plane()
{
    Scenario scenario = steady_push(scene::Turning::free);
    scenario.name += ", own planes";
    scenario.options.has_own_planes = true;
    return scenario;
}

Scenario symmetric_squeeze(scene::Turning turning)
{
    scene::Description scene = lone_cube(turning);
    scene.gravity = {0.0, -9.81, 0.0};
    scene.planes = {platform()};
    scene.hands = springs(1000.0, 2.0, 2);
    Scenario scenario{with("d1 symmetric squeeze 10 s", turning),
                      "itself",
                      {scene, 10.0, squeeze(1e-3, 1e-3)},
                      {}};
    scenario.measure = [](Engine& engine, const Course& course, double tick_s) {
        double drift = 0.0, rotated = 0.0;
        run(engine, course, tick_s, [&](double) {
            const scene::BodyState state = engine.state(0);
            drift = std::max({drift, std::abs(state.position.x()), std::abs(state.position.z())});
            rotated = std::max(
                rotated, angle_between(course.scene.bodies[0].orientation, state.orientation));
        });
        return std::vector<Measure>{{"drift_m", drift, 0.0}, {"turned_rad", rotated, 0.0}};
    };
    return scenario;
}

Scenario squeezed_oscillation(scene::Turning turning, double stiffness)
{
    constexpr double usual = 1000.0, mass = 0.1, start_m = 2e-4, long_s = 10.0;
    scene::Description scene = lone_cube(turning);
    scene.bodies[0].position = {{start_m, 0.0, 0.0}};
    scene.hands = springs(stiffness, 0.0, 2);
    const std::string name = stiffness == usual ? "" : fmt::format(", k = {:.0e} N/m", stiffness);
    Scenario scenario{with("d2 squeezed oscillation" + name, turning),
                      "analytic",
                      {scene, long_s, squeeze(1e-3, 1e-3)},
                      {}};
    scenario.measure = [stiffness](Engine& engine, const Course& course, double tick_s) {
        const double frequency = std::sqrt(2.0 * stiffness / mass);
        const double periods_end = 10.0 * 2.0 * glm::pi<double>() / frequency;
        double squares = 0.0;
        int count = 0;
        run(engine, course, tick_s, [&](double time_s) {
            if (time_s > periods_end) return;
            const double expected = start_m * std::cos(frequency * time_s);
            const double error = (engine.state(0).position.x() - expected) / start_m;
            squares += error * error;
            ++count;
        });
        const scene::BodyState end = engine.state(0);
        const double swing = std::hypot(end.position.x(), end.velocity.x() / frequency) / start_m;
        return std::vector<Measure>{{"relative_rms_10_periods", std::sqrt(squares / count), 1e-9},
                                    {"relative_swing_error_10s", std::abs(swing - 1.0), 1e-9}};
    };
    scenario.has_native = true;
    return scenario;
}

Scenario asymmetric_squeeze(scene::Turning turning)
{
    constexpr double deep_m = 1.5e-3, shallow_m = 5e-4;
    scene::Description scene = lone_cube(turning);
    scene.hands = springs(1000.0, 2.0, 2);
    Scenario scenario{with("d3 asymmetric squeeze", turning),
                      "analytic",
                      {scene, 5.0, squeeze(deep_m, shallow_m)},
                      {}};
    scenario.measure = [](Engine& engine, const Course& course, double tick_s) {
        run(engine, course, tick_s);
        const double expected = (deep_m - shallow_m) / 2.0;
        return std::vector<Measure>{
            {"error_m", std::abs(engine.state(0).position.x() - expected), 1e-12}};
    };
    return scenario;
}

Course paper_course(scene::Turning turning)
{
    constexpr double depth = 1e-3, swing = 5e-3, frequency = 4.0;
    Course course{scene::paper_scene(), 1e4, {}};
    scene::BodyDescription& cube = course.scene.bodies[0];
    cube.turning = turning;
    if (turning == scene::Turning::free) {
        cube.locked = {};
        cube.drag_ns_per_m = 0.0;
        for (auto& body : course.scene.bodies) body.material.friction = 0.3;
        course.scene.planes[0].material.friction = 0.3;
        course.scene.hands.stiffness_n_per_m = 1000.0;
    }
    course.hands = [](std::uint32_t hand, double time_s) {
        const double x = swing * std::sin(frequency * time_s);
        const double speed = swing * frequency * std::cos(frequency * time_s);
        return scene::HandInput{{{x + sign_of(hand) * (reach - depth), 0.0, 0.0}},
                                {{speed, 0.0, 0.0}}};
    };
    course.warm_up_s = 0.1;
    return course;
}

} // namespace hapnet::bench

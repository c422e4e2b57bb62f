// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Cubes that hit and carry each other.
#include "tests/bench/scene/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

std::vector<glm::dvec3> places(const Engine& engine, std::size_t count)
{
    std::vector<glm::dvec3> places;
    for (scene::BodyId i = 0; i < count; ++i) places.push_back(engine.state(i).position.value);
    return places;
}

double farthest(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to)
{
    double most = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const glm::dvec3 moved = to[i] - from[i];
        most = std::max(most, std::sqrt(glm::dot(moved, moved)));
    }
    return most;
}

} // namespace

Scenario wall(double restitution, scene::Turning turning)
{
    constexpr double speed = 0.5, gap = 0.01237; // not reached at the end of a tick
    scene::Description scene = lone_cube(turning);
    scene.bodies[0].velocity = {{speed, 0.0, 0.0}};
    scene::BodyDescription fixed = cube();
    fixed.name = "wall";
    fixed.movable = false;
    fixed.position = {{0.04 + gap, 0.0, 0.0}};
    scene.bodies.push_back(fixed);
    for (auto& body : scene.bodies) body.material = {.friction = 0.0, .restitution = restitution};
    const std::string name = fmt::format("e wall, restitution {:g}{}", restitution,
                                         turning == scene::Turning::locked ? ", locked" : "");
    Scenario scenario{name, "analytic", {scene, 0.0605, {}}, {}};
    scenario.measure = [restitution](Engine& engine, const Course& course, double tick_s) {
        double deepest = 0.0;
        run(engine, course, tick_s,
            [&](double) { deepest = std::max(deepest, engine.state(0).position.x() - gap); });
        const double rebound = -engine.state(0).velocity.x() / speed;
        return std::vector<Measure>{{"restitution_error", std::abs(rebound - restitution), 1e-9},
                                    {"penetration_m", deepest, 1e-12}};
    };
    return scenario;
}

Scenario stack(double duration_s)
{
    constexpr int count = 10;
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.gravity = {0.0, -9.81, 0.0};
    scene.planes = {platform()};
    scene.bodies.clear();
    for (int i = 0; i < count; ++i) {
        scene.bodies.push_back(cube());
        // Not quite above each other, because exactly matching edges are rare in practice.
        scene.bodies.back().position = {
            {i % 2 == 0 ? -1e-4 : 1e-4, 0.04 * i, i % 3 == 0 ? -1e-4 : 5e-5}};
    }
    Scenario scenario{
        fmt::format("f stack of ten, {:g} s", duration_s), "itself", {scene, duration_s, {}}, {}};
    scenario.measure = [](Engine& engine, const Course& course, double tick_s) {
        constexpr double settled_s = 0.5;
        std::vector<glm::dvec3> start, settled;
        for (const auto& body : course.scene.bodies) start.push_back(body.position.value);
        run(engine, course, tick_s, [&](double time_s) {
            if (settled.empty() && time_s >= settled_s) settled = places(engine, start.size());
        });
        const auto end = places(engine, start.size());
        return std::vector<Measure>{{"drift_m", farthest(start, end), 50e-6},
                                    {"creep_after_0.5s_m", farthest(settled, end), 50e-6}};
    };
    scenario.cost_ns_max = 9000.0;
    return scenario;
}

Scenario stack_in_long_ticks()
{
    Scenario scenario = stack(10.0);
    scenario.name = "f stack of ten, 10 s, tick 16 ms";
    scenario.options.tick_s = 16e-3;
    scenario.cost_ns_max = 0.0;
    return scenario;
}

std::vector<Scenario> all_scenarios(bool is_quick)
{
    using scene::Turning;
    std::vector<Scenario> all{ballistic()};
    for (const Turning turning : {Turning::locked, Turning::free}) {
        for (const double degrees : {0.0, 45.0}) all.push_back(slide(degrees, turning));
    }
    for (const Turning turning : {Turning::locked, Turning::free}) {
        all.push_back(bounce(1000.0, 0.0, turning));
        all.push_back(steady_push(turning));
        all.push_back(symmetric_squeeze(turning));
        all.push_back(squeezed_oscillation(turning));
        all.push_back(asymmetric_squeeze(turning));
        for (const double e : {0.0, 0.5, 1.0}) all.push_back(wall(e, turning));
    }
    all.push_back(bounce(1000.0, 0.008, Turning::free));
    all.push_back(squeezed_oscillation(Turning::locked, 1e8));
    all.push_back(squeezed_oscillation(Turning::free, 1e8));
    all.push_back(steady_push_on_own_plane());
    all.push_back(stack(is_quick ? 3.0 : 60.0));
    all.push_back(stack_in_long_ticks());
    all.push_back(tumble());
    all.push_back(off_centre_push());
    for (Scenario& one : element_scenarios()) all.push_back(std::move(one));
    for (Scenario& one : everyday_scenarios()) all.push_back(std::move(one));
    return all;
}

} // namespace hapnet::bench

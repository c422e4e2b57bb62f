// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/tumbling.hpp"

#include "tests/bench/scene/reference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

/// One body above a floor at y = 0, without hands.
Course above_floor(const scene::BodyDescription& body, double friction)
{
    Course course{lone_cube(scene::Turning::free), 1.0, {}};
    scene::PlaneDescription floor = platform();
    floor.offset_m = 0.0;
    course.scene.gravity = {0.0, -9.81, 0.0};
    course.scene.bodies = {body};
    course.scene.planes = {floor};
    course.scene.bodies[0].material.friction = course.scene.planes[0].material.friction = friction;
    return course;
}

double energy_of(const scene::Description& scene, const Engine& engine)
{
    const scene::BodyDescription& body = scene.bodies[0];
    const scene::BodyState state = engine.state(0);
    return kinetic_energy(body, state) -
           body.mass_kg * glm::dot(scene.gravity, state.position.value);
}

} // namespace

Course tumbling_box(double friction)
{
    scene::BodyDescription box = cube();
    box.half = {0.03, 0.02, 0.01};
    box.position = {{0.0, 0.24, 0.0}};
    box.orientation = even_turn(5, 16);
    box.angular_velocity = {30.0, 20.0, 40.0};
    return above_floor(box, friction);
}

Course top()
{
    scene::BodyDescription one = cube();
    one.half = {0.03, 0.02, 0.01};
    const double height = glm::length(one.half);
    const glm::dvec3 diagonal = one.half / height;
    const double angle = std::acos(diagonal.y); // from the diagonal to upright
    const glm::dvec3 axis = glm::normalize(glm::cross(diagonal, glm::dvec3{0.0, 1.0, 0.0}));
    one.orientation = {std::cos(angle / 2.0), std::sin(angle / 2.0) * axis};
    one.position = {{0.0, height, 0.0}};
    one.angular_velocity = {0.0, 300.0, 0.0};
    return above_floor(one, 0.3);
}

Course ledge()
{
    scene::BodyDescription box = cube();
    box.half = {0.03, 0.01, 0.02};
    box.position = {{0.005, 0.21, 0.0}};
    box.velocity = {{0.1, 0.0, 0.0}};
    Course course = above_floor(box, 0.3);
    scene::BodyDescription shelf = cube();
    shelf.name = "shelf";
    shelf.movable = false;
    shelf.half = {0.1, 0.02, 0.1};
    shelf.position = {{-0.1, 0.18, 0.0}};
    course.scene.bodies.push_back(shelf);
    return course;
}

double energy_gain(Engine& engine, const Course& course, double tick_s)
{
    double gain = 0.0, before = energy_of(course.scene, engine);
    run(engine, course, tick_s, [&](double) {
        const double now = energy_of(course.scene, engine);
        gain += std::max(0.0, now - before);
        before = now;
    });
    return gain;
}

std::vector<Row> measure_tumbling(std::span<const Subject> subjects)
{
    std::vector<Row> rows;
    const auto ask = [&](const std::string& name, const Course& course, bool has_target) {
        for (const double tick_ms : {1.0, 0.1}) {
            Question question{tick_ms == 1.0 ? name
                                             : fmt::format("{}, tick {:g} ms", name, tick_ms),
                              "", "energy_gain_j"};
            if (has_target && tick_ms == 1.0) question.ratio_min = 1.0;
            std::vector<Reading> readings;
            for (const Subject& one : subjects) {
                EngineOptions options;
                options.tick_s = tick_ms * 1e-3;
                options.integrator = Integrator::implicit;
                const auto engine = one.make(course.scene, options);
                if (!engine) continue;
                readings.push_back(
                    {one.name, one.family, energy_gain(*engine, course, options.tick_s)});
            }
            append(rows, compare(question, readings));
        }
    };
    for (const double friction : {0.0, 0.4, 2.0}) {
        ask(fmt::format("tumbling box, friction {:g}", friction), tumbling_box(friction), true);
    }
    ask("top on its corner, 300 rad/s", top(), false);
    ask("box over a ledge", ledge(), false);
    return rows;
}

} // namespace hapnet::bench

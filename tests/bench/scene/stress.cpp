// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/stress.hpp"

#include "scene/world.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

constexpr double tick_s = 1e-3;

/// Asks every subject the same.
std::vector<Row> ask(const Question& question, std::span<const Subject> subjects,
                     const std::function<double(const Subject&)>& answer)
{
    std::vector<Reading> readings;
    for (const Subject& one : subjects) readings.push_back({one.name, one.family, answer(one)});
    return compare(question, readings);
}

/// The largest error of bounces that begin at different moments of a tick.
double worst_bounce(const Entry& entry, double stiffness, scene::Turning turning, int phases)
{
    constexpr double way_of_a_tick = 0.1 * tick_s; // metres
    double worst = 0.0;
    for (int i = 0; i < phases; ++i) {
        const double gap = 1.23e-4 + way_of_a_tick * i / phases;
        const Scenario scenario = bounce(stiffness, 0.0, turning, gap);
        const auto engine = entry.subject->make(scenario.course.scene, entry.options);
        if (!engine) return std::numeric_limits<double>::quiet_NaN();
        worst = std::max(worst, scenario.measure(*engine, scenario.course, tick_s)[0].value);
    }
    return worst;
}

std::vector<Row> stiffness(std::span<const Subject> subjects, scene::Turning turning)
{
    std::vector<Row> rows;
    for (const double s : {0.01, 0.1, 0.32, 1.0, 3.2, 10.0, 100.0, 1000.0}) {
        const double mass = 0.1, stiffness = s * mass / (tick_s * tick_s);
        const char* const suffix = turning == scene::Turning::locked ? ", locked" : "";
        const Question question{fmt::format("bounces at k dt^2/m = {:g}{}", s, suffix), "analytic",
                                "worst_relative_energy_error", 1e-9};
        append(rows, ask(question, subjects, [&](const Subject& subject) {
                   return worst_bounce({subject.name, &subject, {}}, stiffness, turning, 8);
               }));
    }
    return rows;
}

/// The bounce of c1 at more moments of a tick, with the peers' own springs too.
std::vector<Row> bounces(std::span<const Subject> subjects, scene::Turning turning)
{
    constexpr int phases = 16;
    constexpr double stiffness = 1000.0;
    const Scenario one = bounce(stiffness, 0.0, turning);
    std::vector<Reading> readings;
    for (const Entry& entry : entries_of(one, subjects)) {
        readings.push_back(
            {entry.name, entry.subject->family, worst_bounce(entry, stiffness, turning, phases)});
    }
    const Question question{fmt::format("{}, worst of {} phases", one.name, phases), "analytic",
                            "worst_relative_energy_error", 1e-9};
    return compare(question, readings);
}

/// Returns the way of the upper of two cubes in 5 s, in metres, if it is `ratio` times as heavy.
double heavy_on_light(const Subject& subject, double ratio)
{
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.gravity = {0.0, -9.81, 0.0};
    scene.planes = {platform()};
    scene.bodies.push_back(cube());
    scene.bodies[1].position = {{0.0, 0.04, 0.0}};
    scene.bodies[1].mass_kg = ratio * scene.bodies[0].mass_kg;
    const auto engine = subject.make(scene, {});
    if (!engine) return std::numeric_limits<double>::infinity();
    double most = 0.0;
    run(*engine, {scene, 5.0, {}}, tick_s, [&](double) {
        const glm::dvec3 moved = engine->state(1).position.value - scene.bodies[1].position.value;
        most = std::max(most, glm::length(moved));
    });
    return std::isfinite(most) ? most : std::numeric_limits<double>::infinity();
}

std::vector<Row> mass_ratios(std::span<const Subject> subjects)
{
    constexpr std::array ratios{10.0, 100.0, 1000.0, 10000.0};
    constexpr double stands_m = 5e-3;
    std::vector<Row> rows = ask(
        {"heavy on light, 5 s", "", "largest_factor_that_stands", 1000.0, 0.0, Direction::at_least},
        subjects, [&](const Subject& subject) {
            return last_held(
                ratios, [&](double ratio) { return heavy_on_light(subject, ratio) < stands_m; });
        });
    append(rows, ask({"1000:1 on light, 5 s", "itself", "moved_m", 5e-4}, subjects,
                     [](const Subject& subject) { return heavy_on_light(subject, 1000.0); }));
    return rows;
}

std::vector<Row> long_ticks(std::span<const Subject> subjects, double duration_s)
{
    constexpr std::array ticks_ms{0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0};
    constexpr double stands_m = 0.02;
    const Scenario scenario = stack(duration_s);
    const auto stands = [&](const Subject& subject, double tick_ms) {
        EngineOptions options;
        options.tick_s = tick_ms * 1e-3;
        const auto engine = subject.make(scenario.course.scene, options);
        return engine &&
               scenario.measure(*engine, scenario.course, options.tick_s)[0].value < stands_m;
    };
    return ask({fmt::format("stack of ten, {:g} s, within 20 mm", duration_s), "",
                "largest_tick_ms", 4.0, 0.0, Direction::at_least},
               subjects, [&](const Subject& subject) {
                   return last_held(ticks_ms,
                                    [&](double tick_ms) { return stands(subject, tick_ms); });
               });
}

bool is_held_by_wall(const Subject& subject, double speed)
{
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.bodies[0].velocity = {{speed, 0.0, 0.0}};
    scene.bodies.push_back(cube());
    scene.bodies[1].movable = false;
    scene.bodies[1].position = {{0.7, 0.0, 0.0}};
    EngineOptions options;
    options.has_fast_bodies = true;
    const auto engine = subject.make(scene, options);
    if (!engine) return false;
    run(*engine, {scene, 1.0 / speed + 0.01, {}}, tick_s);
    return engine->state(0).position.x() < 0.7;
}

std::vector<Row> tunnelling(std::span<const Subject> subjects)
{
    constexpr std::array speeds{10.0, 100.0, 1000.0};
    return ask({"40 mm wall", "", "largest_speed_held_m_per_s", 1000.0, 0.0, Direction::at_least},
               subjects, [&](const Subject& subject) {
                   return last_held(speeds,
                                    [&](double speed) { return is_held_by_wall(subject, speed); });
               });
}

constexpr int shots = 64; // at a wall, each in another orientation and at another phase of a tick

/// True if the i-th of the cubes of 10 mm passes the fixed wall at which it flies. Every second
/// cube spins.
bool passes_wall(const Subject& subject, int i, double speed, double thickness)
{
    constexpr double half = 0.005, extent = 0.5, clear = 0.01;
    constexpr int ticks_before = 2, ticks = 14;
    scene::Description scene = lone_cube(scene::Turning::free);
    scene::BodyDescription& one = scene.bodies[0];
    one.half = glm::dvec3{half};
    one.mass_kg = 0.0015625;
    one.orientation = even_turn(i, shots);
    const double way = speed * tick_s * (ticks_before + static_cast<double>(i) / shots);
    one.position = {{-clear - way, 0.0, 0.0}};
    one.velocity = {{speed, 0.0, 0.0}};
    if (i % 2 == 0) one.angular_velocity = 500.0 * (even_turn(i + 1, shots) * glm::dvec3{1, 0, 0});
    scene.bodies.push_back(cube());
    scene.bodies[1].movable = false;
    scene.bodies[1].half = {thickness / 2.0, extent, extent};
    scene.bodies[1].position = {{thickness / 2.0, 0.0, 0.0}};
    for (auto& body : scene.bodies) body.material.restitution = 0.5;
    EngineOptions options;
    options.has_fast_bodies = true;
    const auto engine = subject.make(scene, options);
    if (!engine) return true;
    bool has_passed = false;
    run(*engine, {scene, ticks * tick_s, {}}, tick_s, [&](double) {
        const glm::dvec3 p = engine->state(0).position.value;
        const bool is_beside = std::abs(p.y) > extent || std::abs(p.z) > extent;
        has_passed = has_passed || (p.x > thickness / 2.0 && !is_beside);
    });
    return has_passed;
}

/// The share of senseless inputs that were refused and left the world as it was.
double refused_share()
{
    auto world = scene::World::freeze(scene::paper_scene());
    if (!world) return 0.0;
    constexpr std::array bad{std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), -1e30};
    int asked = 0, refused = 0;
    const auto note = [&, before = world->hash()](bool is_refused) {
        ++asked;
        if (is_refused && world->hash() == before) ++refused;
    };
    for (const double x : bad) {
        note(world->set_hand(0, {{{x, 0.0, 0.0}}, {}}).has_value());
        note(world->set_hand(0, {{}, {{x, 0.0, 0.0}}}).has_value());
        note(world->push(0, {{x, 0.0, 0.0}}).has_value());
        scene::BodyState state = world->body(0);
        state.velocity.value.y = x;
        note(world->place(0, state).has_value());
        state = world->body(0);
        state.angular_velocity.z = x;
        note(world->place(0, state).has_value());
    }
    return static_cast<double>(refused) / asked;
}

} // namespace

std::vector<Row> turned_cubes(std::span<const Subject> subjects)
{
    constexpr std::array walls_m{0.002, 0.01, 0.02, 0.04};
    std::vector<Row> rows;
    for (const double speed : {10.0, 30.0, 100.0, 300.0, 1000.0}) {
        const Question question{fmt::format("turned cubes at {:g} m/s, walls of 2 to 40 mm", speed),
                                "", fmt::format("passed_of_{}", shots * walls_m.size()), 0.0};
        append(rows, ask(question, subjects, [&](const Subject& subject) {
                   int passed = 0;
                   for (const double wall_m : walls_m) {
                       for (int i = 0; i < shots; ++i) {
                           if (passes_wall(subject, i, speed, wall_m)) ++passed;
                       }
                   }
                   return static_cast<double>(passed);
               }));
    }
    return rows;
}

double last_held(std::span<const double> trials, const std::function<bool(double)>& holds)
{
    double last = 0.0;
    for (const double trial : trials) {
        if (!holds(trial)) break;
        last = trial;
    }
    return last;
}

std::vector<Row> measure_limits(std::span<const Subject> subjects, bool is_quick)
{
    std::vector<Row> rows = stiffness(subjects, scene::Turning::locked);
    append(rows, stiffness(subjects, scene::Turning::free));
    append(rows, bounces(subjects, scene::Turning::locked));
    append(rows, bounces(subjects, scene::Turning::free));
    append(rows, mass_ratios(subjects));
    append(rows, long_ticks(subjects, is_quick ? 1.0 : 10.0));
    append(rows, tunnelling(subjects));
    append(rows, turned_cubes(subjects));
    append(rows,
           compare({"NaN, infinity, 1e30", "", "refused_share", 1.0, 0.0, Direction::at_least},
                   std::vector<Reading>{{"hapnet", own_family, refused_share()}}));
    return rows;
}

} // namespace hapnet::bench

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// Many bodies at once. An engine that needs minutes for a heap is left out of it.
#include "tests/bench/scene/heaps.hpp"

#include "tests/bench/scene/overlap.hpp"
#include "tests/bench/scene/tails.hpp"

#include <array>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

constexpr int runs = 5;                      // of a course whose steps are timed one by one
constexpr double worst_tick_ns = 1e6;        // a tick of a session
constexpr double density_kg_per_m3 = 1562.5; // of the cube of 40 mm and 0.1 kg
constexpr double heap_friction = 0.3;

scene::BodyDescription solid(const glm::dvec3& half)
{
    scene::BodyDescription body{.name = "box", .half = half};
    body.mass_kg = density_kg_per_m3 * 8.0 * half.x * half.y * half.z;
    body.material.friction = heap_friction;
    return body;
}

scene::PlaneDescription side(const glm::dvec3& normal, double offset_m)
{
    scene::PlaneDescription plane{.name = "side", .normal = normal, .offset_m = offset_m};
    plane.material.friction = heap_friction;
    return plane;
}

/// On a floor at y = 0, without hands.
Course on_floor(double duration_s)
{
    scene::Description scene{.name = "heap"};
    scene.planes = {side({0.0, 1.0, 0.0}, 0.0)};
    scene.hands.count = 0;
    return {scene, duration_s, {}};
}

std::vector<Entry> entries_but(std::span<const Subject> subjects,
                               std::initializer_list<std::string_view> left_out)
{
    std::vector<Entry> entries;
    for (const Subject& one : subjects) {
        if (std::find(left_out.begin(), left_out.end(), one.name) != left_out.end()) continue;
        entries.push_back({one.name, &one, {}});
    }
    return entries;
}

/// Returns the deepest overlap during a course, and at its end.
std::vector<Row> penetration(const Course& course, std::span<const Entry> entries,
                             const Question& question)
{
    std::vector<Reading> worst, last;
    for (const Entry& one : entries) {
        const auto engine = one.subject->make(course.scene, one.options);
        if (!engine) continue;
        double deepest = 0.0, now = 0.0;
        run(*engine, course, one.options.tick_s, [&](double) {
            now = deepest_overlap(course.scene, *engine);
            deepest = std::max(deepest, now);
        });
        worst.push_back({one.name, one.subject->family, deepest});
        last.push_back({one.name, one.subject->family, now});
    }
    Question asked = question;
    asked.metric = "penetration_m";
    std::vector<Row> rows = compare(asked, worst);
    asked.metric = "last_penetration_m";
    append(rows, compare(asked, last));
    return rows;
}

} // namespace

Course bin(int count, double friction)
{
    constexpr int columns = 3;
    constexpr double width = 0.22, pitch = 0.072; // wider than any of them, however it is turned
    constexpr std::array halves{glm::dvec3{0.02, 0.02, 0.02}, glm::dvec3{0.025, 0.015, 0.02},
                                glm::dvec3{0.015, 0.02, 0.025}};
    Course course = on_floor(1.0);
    for (const double sign : {-1.0, 1.0}) {
        course.scene.planes.push_back(side({sign, 0.0, 0.0}, -width / 2.0));
        course.scene.planes.push_back(side({0.0, 0.0, sign}, -width / 2.0));
    }
    for (int i = 0; i < count; ++i) {
        const int x = i % columns, z = i / columns % columns, y = i / (columns * columns);
        scene::BodyDescription body = solid(halves[static_cast<std::size_t>(i % 3)]);
        body.position = {{pitch * (x - 1), pitch * (y + 0.6), pitch * (z - 1)}};
        body.orientation = even_turn(i * 89 % count, count); // neighbours unlike each other
        course.scene.bodies.push_back(body);
    }
    for (auto& body : course.scene.bodies) body.material.friction = friction;
    for (auto& plane : course.scene.planes) plane.material.friction = friction;
    return course;
}

Course brick_wall(double speed_m_per_s)
{
    constexpr int columns = 8, rows = 6;
    constexpr double gap = 1e-3;
    const glm::dvec3 half{0.02, 0.02, 0.04};
    Course course = on_floor(0.4);
    scene::BodyDescription ball = solid(glm::dvec3{0.03});
    ball.mass_kg = 1.0;
    ball.position = {{-0.1, 0.12, 0.01}};
    ball.velocity = {{speed_m_per_s, 0.0, 0.0}};
    course.scene.bodies.push_back(ball);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            scene::BodyDescription brick = solid(half);
            const double shift = row % 2 == 0 ? 0.0 : half.z; // in a bond
            brick.position = {{0.0, half.y * (2 * row + 1),
                               (2.0 * half.z + gap) * (column - columns / 2) + shift}};
            course.scene.bodies.push_back(brick);
        }
    }
    return course;
}

Course dominoes()
{
    constexpr int count = 20;
    constexpr double pitch = 0.025;
    const glm::dvec3 half{0.004, 0.024, 0.012};
    Course course = on_floor(0.6);
    for (int i = 0; i < count; ++i) {
        scene::BodyDescription slab = solid(half);
        slab.position = {{pitch * i, half.y, 0.0}};
        course.scene.bodies.push_back(slab);
    }
    // It leans over its lower edge, and falls.
    constexpr double lean = 0.25;
    auto& first = course.scene.bodies.front();
    first.orientation = {std::cos(lean / 2.0), 0.0, 0.0, -std::sin(lean / 2.0)};
    first.position.value = {half.y * std::sin(lean),
                            half.y * std::cos(lean) + half.x * std::sin(lean), 0.0};
    return course;
}

Course pyramid()
{
    constexpr int rows = 10;
    constexpr double pitch = 0.042;
    Course course = on_floor(0.3);
    for (int row = 0; row < rows; ++row) {
        for (int i = 0; i < rows - row; ++i) {
            scene::BodyDescription one = solid(glm::dvec3{0.02});
            one.position = {{pitch * (i + row / 2.0), 0.04 * row + 0.02, 0.0}};
            course.scene.bodies.push_back(one);
        }
    }
    return course;
}

Course stiff_hands()
{
    constexpr double edge = 0.025, depth = 1e-4, swing = 5e-5;
    Course course{lone_cube(scene::Turning::free), 1.0, {}};
    course.scene.hands = {
        .stiffness_n_per_m = 1e6, .damping_ns_per_m = 2.0, .force_max_n = 1e4, .count = 8};
    course.hands = [](std::uint32_t hand, double time_s) {
        // One hand on every face and a second on two, beside the centre, each with its own period.
        const bool is_second = hand >= 6;
        const int axis = is_second ? 0 : static_cast<int>(hand % 3);
        const double sign = (is_second ? hand == 6 : hand < 3) ? -1.0 : 1.0;
        const double beside = is_second ? -0.006 : hand % 2 == 0 ? 0.004 : 0.008;
        const double rate = 20.0 + 7.0 * hand;
        scene::HandInput input;
        input.position.value = {beside, -beside / 2.0, beside / 3.0};
        input.position.value[axis] = sign * (edge - depth + swing * std::sin(rate * time_s));
        input.velocity.value[axis] = sign * swing * rate * std::cos(rate * time_s);
        return input;
    };
    return course;
}

std::vector<Row> measure_heaps(std::span<const Subject> subjects, bool is_quick)
{
    // Engines that need milliseconds per step: ODE's direct solver, and MuJoCo without islands.
    const std::initializer_list<std::string_view> slow{"ode-step", "mujoco"}, slowest{"ode-step"};
    const auto timed = entries_but(subjects, slow);
    const auto many = is_quick ? timed : entries_but(subjects, slowest);
    std::vector<Row> rows = penetration(bin(50, heap_friction), many, {"bin of 50 boxes", "", ""});
    append(rows, penetration(bin(200, heap_friction), many, {"bin of 200 boxes", "", "", {}, 1.0}));
    if (!is_quick) {
        append(rows, penetration(bin(200, 0.0), timed, {"bin of 200 smooth boxes", "", ""}));
    }
    for (const double speed : {10.0, 40.0}) {
        const Question question{fmt::format("1 kg hits a brick wall at {:g} m/s", speed), "", ""};
        auto entries = many;
        for (Entry& one : entries) one.options.has_fast_bodies = true;
        append(rows, penetration(brick_wall(speed), entries, question));
    }
    append(rows,
           tails_of(brick_wall(10.0), timed, {"tail: brick wall hit at 10 m/s", "", ""}, runs));
    append(rows, tails_of(dominoes(), timed, {"tail: 20 dominoes", "", ""}, runs));
    append(rows, tails_of(pyramid(), timed, {"tail: pyramid of 55", "", ""}, runs));
    append(rows, tails_of(stiff_hands(), entries_but(subjects, {}),
                          {"tail: eight stiff hands", "", ""}, runs));
    const auto own = entries_but(subjects.first(1), {});
    append(rows, tails_of(bin(200, heap_friction), is_quick ? own : timed,
                          {"tail: bin of 200 boxes", "", "", worst_tick_ns}, runs));
    return rows;
}

} // namespace hapnet::bench

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// One scenario for each thing that a scene may have beside boxes, planes and smooth hands.
#include "scene/mass.hpp"
#include "tests/bench/scene/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace hapnet::bench {

namespace {

constexpr double gravity = 9.81;
constexpr double friction = 0.3; // of cube() and platform()

using Place = std::function<glm::dvec3(double time_s)>;

/// A scenario whose first body has to be at a place at the end.
Scenario ends_at(const std::string& name, const std::string& reference, const Course& course,
                 const Place& expected)
{
    Scenario scenario{name, reference, course, {}};
    scenario.measure = [expected](Engine& engine, const Course& run_of, double tick_s) {
        run(engine, run_of, tick_s);
        const glm::dvec3 missed = engine.state(0).position.value - expected(run_of.duration_s);
        return std::vector<Measure>{{"error_m", glm::length(missed), {}}};
    };
    return scenario;
}

/// A body on the platform, under gravity, without hands.
scene::Description on_platform(const scene::BodyDescription& body)
{
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.gravity = {0.0, -gravity, 0.0};
    scene.bodies = {body};
    scene.planes = {platform()};
    return scene;
}

/// A round body that slides until it rolls. `moment`: its moment of inertia per m r^2.
Scenario rolls(const std::string& name, const scene::BodyDescription& body, double moment)
{
    constexpr double braked = friction * gravity;
    const double start = body.velocity.x();
    const double rolling_speed = start / (1.0 + moment);
    const double slid_s = (start - rolling_speed) / braked;
    const double slid = slid_s * 0.5 * (start + rolling_speed);
    return ends_at(name, "analytic", {on_platform(body), 0.5, {}}, [=](double t) {
        return glm::dvec3{slid + (t - slid_s) * rolling_speed, 0.0, 0.0};
    });
}

Scenario ball_that_rolls()
{
    scene::BodyDescription ball = cube();
    ball.shape = scene::Shape::sphere;
    ball.velocity = {{0.5, 0.0, 0.0}};
    return rolls("k sphere slides, then rolls", ball, 0.4);
}

Scenario capsule_that_rolls()
{
    scene::BodyDescription capsule = cube();
    capsule.shape = scene::Shape::capsule;
    capsule.half.z = 0.05;
    capsule.velocity = {{0.5, 0.0, 0.0}};
    const double square = capsule.half.x * capsule.half.x;
    return rolls("k capsule slides, then rolls", capsule,
                 scene::inertia_of(capsule).z / (capsule.mass_kg * square));
}

Scenario sledge()
{
    constexpr double speed = 0.5;
    const glm::dvec3 way{0.6, 0.0, 0.8};
    scene::BodyDescription plate = cube();
    plate.half = {0.04, 0.005, 0.03};
    plate.position = {{0.0, 0.005, 0.0}};
    plate.velocity = {speed * way};
    for (const double side : {-1.0, 1.0}) {
        plate.parts.push_back(
            {.half = {0.04, 0.01, 0.005}, .position = {{0.0, -0.015, 0.02 * side}}});
    }
    const glm::dvec3 start = scene::frame_of_mass(plate).centre.value;
    return ends_at(
        "k compound slides to rest", "analytic", {on_platform(plate), 0.3, {}},
        [=](double) { return start + speed * speed / (2.0 * friction * gravity) * way; });
}

/// The place of a damped oscillator, released at a distance of 1 from equilibrium.
double swings(double mass, double stiffness, double damping, double time_s)
{
    const double decay = damping / (2.0 * mass);
    const double rate = std::sqrt(stiffness / mass - decay * decay);
    return std::exp(-decay * time_s) *
           (std::cos(rate * time_s) + decay / rate * std::sin(rate * time_s));
}

Scenario guided_cube()
{
    constexpr double pulled = 0.01;
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.bodies[0].position = {{pulled, 0.0, 0.0}};
    scene::FieldDescription guide{.name = "guide"};
    guide.damping_ns_per_m = 0.2;
    guide.stiffness_n_per_m = 50.0;
    guide.line = glm::dvec3{0.0, 0.0, 1.0};
    guide.on_bodies = true;
    scene.fields = {guide};
    const double mass = scene.bodies[0].mass_kg;
    return ends_at("m field: a cube on a guide", "analytic", {scene, 1.0, {}}, [=](double t) {
        return glm::dvec3{pulled * swings(mass, guide.stiffness_n_per_m, guide.damping_ns_per_m, t),
                          0.0, 0.0};
    });
}

Scenario cube_on_a_belt()
{
    constexpr double speed = 0.5;
    scene::Description scene = on_platform(cube());
    scene.planes.clear();
    scene::BodyDescription belt = cube();
    belt.name = "belt";
    belt.movable = false;
    belt.kinematic = true;
    belt.half = {1.0, 0.01, 0.1};
    belt.position = {{0.0, -0.03, 0.0}};
    belt.velocity = {{speed, 0.0, 0.0}};
    scene.bodies.push_back(belt);
    return ends_at("m kinematic body: a cube on a belt", "analytic", {scene, 0.4, {}},
                   [](double t) {
                       const double lag = speed * speed / (2.0 * friction * gravity);
                       return glm::dvec3{speed * t - lag, 0.0, 0.0};
                   });
}

constexpr double hand_stiffness = 500.0, hand_damping = 2.0;

Scenario hand_on_a_plane()
{
    constexpr double depth = 2e-3, swing = 1e-3, rate = 30.0;
    scene::Description scene = lone_cube(scene::Turning::free);
    scene.bodies[0].position = {{0.5, 0.5, 0.0}};
    scene.planes = {platform()};
    scene.planes[0].felt = true;
    scene.hands = {.stiffness_n_per_m = hand_stiffness,
                   .damping_ns_per_m = hand_damping,
                   .force_max_n = 1e6,
                   .count = 1};
    Scenario scenario{"m a hand presses a plane", "analytic", {scene, 1.0, {}}, {}};
    const double top = scene.planes[0].offset_m + scene.hands.radius_m - depth;
    scenario.course.hands = [=](std::uint32_t, double t) {
        return scene::HandInput{.position = {{0.0, top - swing * std::sin(rate * t), 0.0}},
                                .velocity = {{0.0, -swing * rate * std::cos(rate * t), 0.0}}};
    };
    scenario.measure = [=](Engine& engine, const Course& course, double tick_s) {
        double worst = 0.0;
        run(engine, course, tick_s, [&](double end) {
            const double start = end - tick_s; // the mean of the force in between
            const double sine = std::sin(rate * end) - std::sin(rate * start);
            const double cosine = std::cos(rate * end) - std::cos(rate * start);
            const double mean = hand_stiffness * (depth - swing * cosine / (rate * tick_s)) +
                                hand_damping * swing * sine / tick_s;
            worst = std::max(worst, std::abs(-engine.hip_force(0).y - mean));
        });
        return std::vector<Measure>{{"worst_force_error_n", worst, {}}};
    };
    return scenario;
}

constexpr double sticking = 0.6, sliding = 0.4;
constexpr double spring_of_the_cube = 50.0, drawn = 0.05, push = 1.0;

/// Returns the place of a mass on a spring over which a hand is drawn, every quarter of a
/// millisecond: this library's friction law in steps of a microsecond.
std::vector<double> sticks_and_slips(double mass, int quarters)
{
    constexpr double step = 1e-6;
    constexpr int steps_of_a_quarter = 250;
    double place = 0.0, speed = 0.0, stretch = 0.0;
    bool slides = false;
    std::vector<double> places{place};
    for (int i = 0; i < quarters * steps_of_a_quarter; ++i) {
        const double over = drawn - speed;
        const double limit = (slides ? sliding : sticking) * push;
        double pull = hand_stiffness * stretch + hand_damping * over;
        stretch += step * over;
        slides = std::abs(pull) > limit;
        if (slides) {
            pull = std::copysign(limit, pull);
            stretch = std::clamp(stretch, -limit / hand_stiffness, limit / hand_stiffness);
        }
        speed += step / mass * (pull - spring_of_the_cube * place);
        place += step * speed;
        if ((i + 1) % steps_of_a_quarter == 0) places.push_back(place);
    }
    return places;
}

Scenario stick_and_slip()
{
    constexpr double quarter_s = 0.25e-3, duration_s = 2.0;
    scene::Description scene = on_platform(cube());
    scene.bodies[0].half.x = 0.5; // a long way to draw the hand over
    scene.bodies[0].turning = scene::Turning::locked;
    scene.bodies[0].material.friction = scene.planes[0].material.friction = 0.0;
    scene.bodies[0].feel.static_friction = sticking;
    scene.bodies[0].feel.dynamic_friction = sliding;
    scene::FieldDescription spring{.name = "spring"};
    spring.stiffness_n_per_m = spring_of_the_cube;
    spring.line = glm::dvec3{0.0, 1.0, 0.0};
    spring.on_hands = false;
    spring.on_bodies = true;
    scene.fields = {spring};
    scene.hands = {.stiffness_n_per_m = hand_stiffness,
                   .damping_ns_per_m = hand_damping,
                   .force_max_n = 1e6,
                   .count = 1,
                   .static_friction = sticking,
                   .dynamic_friction = sliding};
    Scenario scenario{
        "m hand friction: six times stick and slip", "1 us steps", {scene, duration_s, {}}, {}};
    const double height = scene.bodies[0].half.y + scene.hands.radius_m - push / hand_stiffness;
    scenario.course.hands = [=](std::uint32_t, double t) {
        return scene::HandInput{.position = {{-0.2 + drawn * t, height, 0.0}},
                                .velocity = {{drawn, 0.0, 0.0}}};
    };
    const auto quarters = static_cast<int>(std::lround(duration_s / quarter_s));
    scenario.measure = [places = sticks_and_slips(scene.bodies[0].mass_kg, quarters)](
                           Engine& engine, const Course& course, double tick_s) {
        double worst = 0.0;
        run(engine, course, tick_s, [&](double time_s) {
            const auto at = static_cast<std::size_t>(std::lround(time_s / quarter_s));
            worst = std::max(worst, std::abs(engine.state(0).position.x() - places[at]));
        });
        return std::vector<Measure>{{"worst_error_m", worst, {}}};
    };
    return scenario;
}

} // namespace

std::vector<Scenario> element_scenarios()
{
    return {ball_that_rolls(), capsule_that_rolls(), sledge(),        guided_cube(),
            cube_on_a_belt(),  hand_on_a_plane(),    stick_and_slip()};
}

} // namespace hapnet::bench

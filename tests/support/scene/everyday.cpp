// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/scene/everyday.hpp"

#include "tests/support/scene/dice.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::test {

namespace {

using scene::BodyDescription;
using scene::BodyState;
using scene::Description;
using scene::Shape;

double norm(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

glm::dquat random_turn(Dice& dice)
{
    const double w = dice.sign();
    const glm::dvec3 v = dice.vector();
    const double size = std::sqrt(w * w + glm::dot(v, v));
    return size > 0.0 ? glm::dquat{w / size, v.x / size, v.y / size, v.z / size}
                      : glm::dquat{1.0, 0.0, 0.0, 0.0};
}

BodyDescription fixed_box(const glm::dvec3& half, const glm::dvec3& at,
                          const scene::Material& material)
{
    BodyDescription body;
    body.movable = false;
    body.half = half;
    body.position.value = at;
    body.material = material;
    return body;
}

/// Adds six walls around a room, or five, for a room that is open above.
void add_room(Description& scene, const glm::dvec3& room, const scene::Material& material,
              bool is_open)
{
    constexpr double thick = 0.02;
    for (const int axis : {0, 1, 2}) {
        for (const double side : {-1.0, 1.0}) {
            if (is_open && axis == 1 && side > 0.0) continue;
            glm::dvec3 half = room + 2.0 * thick;
            half[axis] = thick;
            glm::dvec3 at{0.0};
            at[axis] = side * (room[axis] + thick);
            scene.bodies.push_back(fixed_box(half, at, material));
        }
    }
}

bool overlaps_any(const Description& scene, const BodyDescription& body)
{
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const BodyDescription& other) { return boxes_overlap(body, other); });
}

void set_shape(Dice& dice, BodyDescription& body, double least, double most)
{
    switch (dice.below(4)) {
    case 0: body.half = glm::dvec3{dice.power(least, most)}; break;
    case 1:
        body.shape = Shape::sphere;
        body.half = glm::dvec3{dice.power(least, most)};
        break;
    case 2: {
        body.shape = Shape::capsule;
        const double radius = dice.power(least, 0.5 * most);
        body.half = glm::dvec3{radius};
        body.half[static_cast<int>(dice.below(3))] = radius * dice.between(1.2, 2.0);
        break;
    }
    default:
        for (const int axis : {0, 1, 2}) body.half[axis] = dice.power(least, most);
    }
}

struct Mood {
    double mass_least, mass_most;
    double spin; // rad/s, of the fastest
};

void add_bodies(Dice& dice, EverydayPlay& play, const Mood& mood, const scene::Material& material)
{
    const std::uint64_t count = 1 + dice.below(10);
    const bool is_still = dice.one_in(3);
    const bool is_even = dice.one_in(2); // boxes along the axes
    for (std::uint64_t i = 0; i < count; ++i) {
        for (int tries = 0; tries < 40; ++tries) {
            BodyDescription body;
            set_shape(dice, body, 0.005, 0.05);
            body.mass_kg = dice.power(mood.mass_least, mood.mass_most);
            body.material = material;
            const glm::dvec3 inner = play.room - norm(body.half);
            if (std::min({inner.x, inner.y, inner.z}) <= 0.0) continue;
            body.position.value = inner * dice.vector();
            if (!is_even) body.orientation = random_turn(dice);
            if (!is_still) {
                body.velocity.value = dice.between(0.0, 2.0) * dice.vector();
                const glm::dvec3 axis = dice.vector();
                body.angular_velocity = (dice.share() * mood.spin / (1e-9 + norm(axis))) * axis;
            }
            if (overlaps_any(play.description, body)) continue;
            play.description.bodies.push_back(body);
            break;
        }
    }
}

void add_hands(Dice& dice, EverydayPlay& play)
{
    scene::HandDescription& hands = play.description.hands;
    hands.count = static_cast<std::uint32_t>(dice.below(3));
    hands.stiffness_n_per_m = dice.power(100.0, 1e6);
    hands.damping_ns_per_m = dice.one_in(2) ? 0.0 : dice.power(0.1, 10.0);
    if (dice.one_in(2)) hands.force_max_n = 3.3;
    const double tick = base::to_seconds(play.options.tick);
    for (std::uint32_t hand = 0; hand < hands.count; ++hand) {
        // Starts outside of the room, so that no spring is pressed at the start.
        const glm::dvec3 from{0.0, 2.0 * play.room.y + 0.2, 0.0};
        play.hands.push_back(from);
        play.legs.emplace_back();
        glm::dvec3 at = from;
        for (std::uint32_t ticks = 0; ticks < play.ticks;) {
            const glm::dvec3 to = 1.1 * play.room * dice.vector();
            const double speed = dice.power(0.05, 2.0);
            const double way = norm(to - at);
            const auto leg = static_cast<std::uint32_t>(std::ceil(way / (speed * tick))) + 1;
            play.legs.back().push_back({leg, (to - at) / (static_cast<double>(leg) * tick)});
            at = to;
            ticks += leg;
        }
    }
}

scene::Material random_material(Dice& dice)
{
    scene::Material material;
    material.friction = dice.one_in(3) ? 0.0 : dice.between(0.0, 2.0);
    material.restitution = dice.one_in(3) ? 0.0 : dice.one_in(3) ? 1.0 : dice.share();
    return material;
}

void set_mild(Dice& dice, EverydayPlay& play, const Mood& mood)
{
    for (const int axis : {0, 1, 2}) play.room[axis] = dice.between(0.08, 0.3);
    const scene::Material material = random_material(dice);
    if (dice.one_in(4)) play.description.gravity = glm::dvec3{0.0};
    const bool is_open = play.description.gravity.y < 0.0 && dice.one_in(2);
    add_room(play.description, play.room, material, is_open);
    add_bodies(dice, play, mood, material);
    if (dice.one_in(2)) add_hands(dice, play);
    play.height = 2.0 * play.room.y;
    play.is_open = is_open;
}

void set_tray(Dice& dice, EverydayPlay& play)
{
    const scene::Material material{dice.one_in(3) ? 0.0 : dice.between(0.1, 0.6),
                                   dice.between(0.0, 0.9)};
    play.room = {dice.between(0.04, 0.08), 0.1, dice.between(0.04, 0.08)};
    add_room(play.description, play.room, material, true);
    const std::uint64_t count = 2 + dice.below(5);
    const glm::dvec3 half{dice.between(0.006, 0.012), dice.between(0.003, 0.005),
                          dice.between(0.001, 0.003)};
    for (std::uint64_t i = 0; i < count; ++i) {
        BodyDescription body;
        body.half = half;
        body.mass_kg = 0.005;
        body.material = material;
        body.position.value = {0.015 * dice.sign(), 0.15 + 0.03 * static_cast<double>(i),
                               0.015 * dice.sign()};
        body.orientation = random_turn(dice);
        body.angular_velocity = 10.0 * dice.vector();
        body.velocity.value = {0.0, -dice.between(0.0, 2.0), 0.0};
        play.description.bodies.push_back(body);
    }
    play.height = 0.5;
    play.is_open = true;
}

void set_rattle(Dice& dice, EverydayPlay& play)
{
    const scene::Material material{dice.one_in(2) ? 0.0 : 0.3, dice.between(0.5, 1.0)};
    play.room = glm::dvec3{dice.between(0.05, 0.1)};
    play.description.gravity = glm::dvec3{0.0};
    add_room(play.description, play.room, material, false);
    BodyDescription body;
    body.half = {dice.between(0.01, 0.02), dice.between(0.006, 0.01), dice.between(0.003, 0.006)};
    body.material = material;
    body.position.value = (play.room - norm(body.half)) * dice.vector();
    body.velocity.value = 1.5 * dice.vector();
    body.angular_velocity = dice.between(0.0, 1000.0) * dice.vector();
    play.description.bodies.push_back(body);
}

void set_pens(Dice& dice, EverydayPlay& play)
{
    const scene::Material material{dice.between(0.3, 0.8), 0.0};
    play.room = {0.5, 0.0, 0.5};
    play.is_open = true;
    play.description.planes.push_back({.name = "table", .material = material});
    BodyDescription pen;
    pen.shape = Shape::capsule;
    const double radius = dice.between(0.005, 0.02);
    pen.half = {radius, radius, radius * dice.between(3.0, 8.0)};
    pen.position.value.y = radius;
    pen.movable = dice.one_in(2);
    pen.material = material;
    BodyDescription plate;
    plate.half = {dice.between(0.5, 2.0) * radius, dice.between(0.1, 0.5) * radius,
                  dice.between(0.3, 0.9) * pen.half.z};
    plate.position.value = {0.0, 2.0 * radius + plate.half.y,
                            dice.one_in(2) ? 0.0 : 0.1 * dice.sign() * plate.half.z};
    plate.mass_kg = dice.between(0.02, 0.2);
    plate.material = material;
    play.description.bodies = {pen, plate};
    play.height = 0.1;
}

void set_cradle(Dice& dice, EverydayPlay& play)
{
    play.room = {10.0, 0.1, 0.1};
    play.description.gravity = glm::dvec3{0.0};
    const std::uint64_t count = 3 + dice.below(5);
    const double gap = dice.one_in(2) ? 0.0 : dice.power(1e-6, 1e-3);
    BodyDescription ball;
    ball.shape = Shape::sphere;
    ball.half = glm::dvec3{dice.between(0.005, 0.02)};
    ball.material = {0.0, 1.0};
    ball.mass_kg = 0.05;
    for (std::uint64_t i = 0; i < count; ++i) {
        ball.position.value.x = static_cast<double>(i) * (2.0 * ball.half.x + gap);
        play.description.bodies.push_back(ball);
    }
    ball.position.value.x = -2.0 * ball.half.x - dice.between(0.01, 0.1);
    ball.velocity.value.x = dice.between(0.2, 2.0);
    play.description.bodies.push_back(ball);
    play.ticks = 500;
}

glm::dvec3 moments_of(const BodyDescription& form)
{
    const double mass = form.mass_kg;
    const glm::dvec3 h = form.half;
    if (form.shape == Shape::sphere) return glm::dvec3{0.4 * mass * h.x * h.x};
    if (form.shape == Shape::box)
        return (mass / 3.0) *
               glm::dvec3{h.y * h.y + h.z * h.z, h.z * h.z + h.x * h.x, h.x * h.x + h.y * h.y};
    const int axis = h.x > h.y ? 0 : h.y > h.z ? 1 : 2;
    const double radius = std::min({h.x, h.y, h.z});
    const double tube = 2.0 * (h[axis] - radius);
    const double ends = 4.0 / 3.0 * radius; // of the length of a tube with their volume
    const double tube_mass = mass * tube / (tube + ends), ends_mass = mass - tube_mass;
    const double offset = 0.5 * tube + 0.375 * radius;
    const double across = tube_mass * (0.25 * radius * radius + tube * tube / 12.0) +
                          ends_mass * (83.0 / 320.0 * radius * radius + offset * offset);
    glm::dvec3 inertia{across};
    inertia[axis] = 0.5 * tube_mass * radius * radius + 0.4 * ends_mass * radius * radius;
    return inertia;
}

/// Moves the hands of a play, and adds up their work.
class Hands {
public:
    explicit Hands(const EverydayPlay& play)
        : play_{play}, at_{play.hands}, leg_(at_.size(), 0), left_(at_.size(), 0)
    {}

    void feed(scene::World& world)
    {
        velocity_.resize(at_.size());
        for (std::uint32_t i = 0; i < at_.size(); ++i) {
            while (left_[i] == 0) {
                left_[i] = play_.legs[i][leg_[i]].ticks;
                velocity_[i] = play_.legs[i][leg_[i]++].velocity;
            }
            --left_[i];
            world.set_hand(i, {.position = {at_[i]}, .velocity = {velocity_[i]}});
            at_[i] += base::to_seconds(play_.options.tick) * velocity_[i];
        }
    }
    void add_work(const scene::World& world)
    {
        for (std::uint32_t i = 0; i < at_.size(); ++i) {
            const glm::dvec3 felt = world.touch(i).on_hand.value;
            const double done =
                -glm::dot(felt, velocity_[i]) * base::to_seconds(play_.options.tick);
            work_ += done;
            exchanged_ += std::abs(done);
        }
    }
    [[nodiscard]] double work() const { return work_; }
    [[nodiscard]] double exchanged() const { return exchanged_; }

private:
    const EverydayPlay& play_;
    std::vector<glm::dvec3> at_, velocity_{};
    std::vector<std::size_t> leg_;
    std::vector<std::uint32_t> left_;
    double work_ = 0.0, exchanged_ = 0.0;
};

double energy_of(const scene::World& world, const Description& scene)
{
    double sum = 0.0;
    for (scene::BodyId id = 0; id < scene.bodies.size(); ++id) {
        const BodyDescription& form = scene.bodies[id];
        if (!form.movable) continue;
        const BodyState state = world.body(id);
        sum += kinetic_energy_of(form, state) -
               form.mass_kg * glm::dot(scene.gravity, state.position.value);
    }
    return sum;
}

/// True if a place is outside of the walls. A body that leaves an open room at the top may lie
/// beside the room, but not below it.
bool is_out(const EverydayPlay& play, const glm::dvec3& place)
{
    const glm::dvec3 beyond = glm::abs(place) - play.room;
    if (!play.is_open) return std::max({beyond.x, beyond.y, beyond.z}) > 0.0;
    return place.y < -play.room.y && std::max(beyond.x, beyond.z) < 0.0;
}

} // namespace

std::string_view name_of(Everyday kind)
{
    constexpr std::array<std::string_view, everyday_kinds> names{"mild", "tray",   "rattle",
                                                                 "pens", "cradle", "hostile"};
    return names.at(static_cast<std::size_t>(kind));
}

double kinetic_energy_of(const BodyDescription& form, const BodyState& state)
{
    const glm::dvec3 own = glm::conjugate(state.orientation) * state.angular_velocity;
    const glm::dvec3& v = state.velocity.value;
    return 0.5 * form.mass_kg * glm::dot(v, v) + 0.5 * glm::dot(moments_of(form) * own, own);
}

bool boxes_overlap(const BodyDescription& a, const BodyDescription& b)
{
    const glm::dmat3 of_a = glm::mat3_cast(a.orientation), of_b = glm::mat3_cast(b.orientation);
    const glm::dvec3 apart = b.position.value - a.position.value;
    const auto separates = [&](const glm::dvec3& axis) {
        double extent = 0.0;
        for (const int i : {0, 1, 2})
            extent += a.half[i] * std::abs(glm::dot(of_a[i], axis)) +
                      b.half[i] * std::abs(glm::dot(of_b[i], axis));
        return std::abs(glm::dot(apart, axis)) >= extent && glm::dot(axis, axis) > 1e-12;
    };
    for (const int i : {0, 1, 2}) {
        if (separates(of_a[i]) || separates(of_b[i])) return false;
        for (const int j : {0, 1, 2})
            if (separates(glm::cross(of_a[i], of_b[j]))) return false;
    }
    return true;
}

EverydayPlay everyday_play(Everyday kind, std::uint64_t seed, base::Duration tick)
{
    Dice dice{base::Seed{seed}.stream(name_of(kind))};
    EverydayPlay play;
    play.options.tick = tick;
    play.description.hands.count = 0;
    switch (kind) {
    case Everyday::mild: set_mild(dice, play, {0.05, 0.5, 500.0}); break;
    case Everyday::hostile: set_mild(dice, play, {1e-3, 1e3, 500.0}); break;
    case Everyday::tray: set_tray(dice, play); break;
    case Everyday::rattle: set_rattle(dice, play); break;
    case Everyday::pens: set_pens(dice, play); break;
    case Everyday::cradle: set_cradle(dice, play); break;
    }
    return play;
}

EverydayOutcome play_everyday(const EverydayPlay& play)
{
    EverydayOutcome outcome;
    const Description& scene = play.description;
    auto frozen = scene::World::freeze(scene, play.options);
    if (!frozen) return {.gain = HUGE_VAL, .kept = 0.0, .has_escaped = true};
    scene::World& world = *frozen;
    Hands hands{play};
    const double start = energy_of(world, scene);
    double scale = 0.0;
    for (const BodyDescription& form : scene.bodies) {
        if (!form.movable) continue;
        const BodyState state{form.position, form.orientation, form.velocity,
                              form.angular_velocity};
        scale += kinetic_energy_of(form, state) + form.mass_kg * norm(scene.gravity) * play.height;
    }
    double energy = start;
    for (std::uint32_t tick = 0; tick < play.ticks; ++tick) {
        hands.feed(world);
        world.tick();
        hands.add_work(world);
        energy = energy_of(world, scene);
        const double scale_now = scale + hands.exchanged();
        if (scale_now == 0.0) continue; // nothing moves yet
        const double gain = (energy - start - hands.work()) / scale_now;
        if (!(gain <= outcome.gain)) outcome.gain = std::isnan(gain) ? HUGE_VAL : gain;
    }
    outcome.kept = energy / start;
    for (scene::BodyId id = 0; id < scene.bodies.size(); ++id) {
        const BodyDescription& form = scene.bodies[id];
        if (!form.movable) continue;
        const BodyState state = world.body(id);
        outcome.restless =
            std::max(outcome.restless,
                     norm(state.velocity.value) + norm(form.half) * norm(state.angular_velocity));
        outcome.has_escaped = outcome.has_escaped || is_out(play, state.position.value);
    }
    return outcome;
}

} // namespace hapnet::test

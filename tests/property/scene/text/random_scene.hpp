// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "scene/description.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace hapnet::scene {

/// Draws scenes from the whole space of valid scenes, without regard to sense.
class RandomScene {
public:
    explicit RandomScene(std::uint64_t seed) : stream_{base::Seed{seed}.stream("scenes")} {}

    Description description()
    {
        Description drawn;
        drawn.name = name();
        for (auto left = below(4); left > 0; --left) drawn.bodies.push_back(body());
        for (auto left = below(3); left > 0; --left) {
            drawn.planes.push_back(
                {name(), unit(), within(reach_max_m), material(), below(2) == 0});
        }
        drawn.hands = hands();
        for (auto left = std::min<std::uint64_t>(below(3), drawn.hands.count); left > 0; --left)
            drawn.own_hands.push_back(feel());
        for (auto left = below(3); left > 0; --left) drawn.fields.push_back(field());
        if (below(2) == 0) drawn.gravity = vector(gravity_max_m_per_s2);
        return drawn;
    }

    /// From -most to most: any power of ten, a round number, or a zero of either sign.
    double within(double most)
    {
        const double sign = below(2) == 0 ? 1.0 : -1.0;
        switch (below(4)) {
        case 0: return sign * 0.0;
        case 1: return sign * most * static_cast<double>(below(1001)) / 1000.0;
        case 2: return sign * most * stream_.uniform(index_++);
        default: return sign * most * std::ldexp(stream_.uniform(index_++), -power());
        }
    }

private:
    std::uint64_t bits() { return stream_.bits(index_++); }
    std::uint64_t below(std::uint64_t most) { return bits() % most; }
    int power() { return static_cast<int>(below(1060)); } // down to the smallest numbers

    double between(double least, double most)
    {
        return std::min(std::max(least, std::abs(within(most))), most);
    }

    std::string name()
    {
        constexpr std::array<const char*, 4> names{"", "x", "a \"quoted\" \\ name\n\t\x7f",
                                                   "\xc3\xa4#="};
        return names[below(names.size())];
    }

    glm::dvec3 vector(double most) { return {within(most), within(most), within(most)}; }

    glm::dvec3 unit()
    {
        const glm::dvec3 v{within(1.0), within(1.0), 1.0};
        return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    }

    glm::dquat orientation()
    {
        if (below(3) == 0) return {1.0, 0.0, 0.0, 0.0};
        const glm::dquat q{within(1.0), 1.0, within(1.0), within(1.0)};
        return q / std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    }

    Material material() { return {std::abs(within(friction_max)), std::abs(within(1.0))}; }

    FieldDescription field()
    {
        FieldDescription drawn{.name = name()};
        drawn.position.value = vector(reach_max_m);
        if (below(2) == 0) drawn.half = glm::dvec3{between(size_min_m, size_max_m)};
        drawn.force.value = vector(force_max_n);
        drawn.damping_ns_per_m = std::abs(within(damping_max_ns_per_m));
        drawn.stiffness_n_per_m = std::abs(within(stiffness_max_n_per_m));
        if (below(2) == 0) drawn.line = unit();
        if (below(2) == 0) drawn.force_limit_n = std::abs(within(force_max_n));
        drawn.on_hands = below(2) == 0;
        drawn.on_bodies = below(2) == 0;
        return drawn;
    }

    Feel feel()
    {
        Feel drawn;
        if (below(2) == 0) drawn.stiffness_n_per_m = std::abs(within(stiffness_max_n_per_m));
        if (below(2) == 0) drawn.damping_ns_per_m = std::abs(within(damping_max_ns_per_m));
        if (below(2) == 0) drawn.static_friction = std::abs(within(friction_max));
        if (below(2) == 0)
            drawn.dynamic_friction = std::abs(within(drawn.static_friction.value_or(friction_max)));
        return drawn;
    }

    PartDescription part()
    {
        PartDescription drawn;
        drawn.half = glm::dvec3{between(size_min_m, size_max_m)};
        if (below(2) == 0) drawn.half.z = between(size_min_m, size_max_m);
        if (drawn.half.z == drawn.half.x && below(2) == 0) drawn.shape = Shape::sphere;
        drawn.position.value = vector(size_max_m);
        drawn.orientation = orientation();
        return drawn;
    }

    BodyDescription body()
    {
        BodyDescription drawn{.name = name()};
        drawn.movable = below(3) != 0;
        drawn.kinematic = !drawn.movable && below(2) == 0;
        drawn.half = glm::dvec3{between(size_min_m, size_max_m)};
        if (below(2) == 0) drawn.half.z = between(size_min_m, size_max_m);
        drawn.shape = static_cast<Shape>(below(3));
        if (drawn.shape == Shape::sphere) drawn.half.z = drawn.half.x;
        if (drawn.shape == Shape::capsule) {
            drawn.half.z = drawn.half.x; // the longest of the two
            drawn.half.x = drawn.half.y = 0.5 * (size_min_m + drawn.half.z);
            if (drawn.half.x == drawn.half.z) drawn.shape = Shape::sphere;
        }
        drawn.position.value = vector(reach_max_m);
        drawn.orientation = orientation();
        drawn.velocity.value = vector(speed_max_m_per_s);
        drawn.angular_velocity = vector(turn_max_rad_per_s);
        if (drawn.kinematic && below(2) == 0) {
            drawn.velocity = {};
            drawn.sway.period = base::Duration{static_cast<std::int64_t>(1 + below(1000)) *
                                               std::chrono::milliseconds{77}};
            drawn.sway.by = vector(1.0);
        }
        drawn.mass_kg = between(mass_min_kg, mass_max_kg);
        drawn.turning = static_cast<Turning>(below(5));
        drawn.locked.x = below(2) == 0;
        drawn.locked.y = below(2) == 0;
        drawn.locked.z = below(2) == 0;
        drawn.material = material();
        if (below(2) == 0) drawn.feel = feel();
        drawn.drag_ns_per_m = std::abs(within(damping_max_ns_per_m));
        for (std::uint64_t left = below(3); left > 0; --left) drawn.parts.push_back(part());
        return drawn;
    }

    HandDescription hands()
    {
        HandDescription drawn;
        drawn.radius_m = between(size_min_m, size_max_m);
        drawn.stiffness_n_per_m = std::abs(within(stiffness_max_n_per_m));
        drawn.damping_ns_per_m = std::abs(within(damping_max_ns_per_m));
        drawn.force_max_n =
            below(3) == 0 ? std::numeric_limits<double>::infinity() : std::abs(within(force_max_n));
        drawn.grip_reach_m = std::abs(within(size_max_m));
        drawn.count = static_cast<std::uint32_t>(below(hands_max + 1));
        if (below(2) == 0) drawn.static_friction = std::abs(within(friction_max));
        if (below(2) == 0) drawn.dynamic_friction = std::abs(within(drawn.static_friction));
        return drawn;
    }

    base::RandomStream stream_;
    std::uint64_t index_ = 0;
};

} // namespace hapnet::scene

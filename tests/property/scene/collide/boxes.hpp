// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "scene/collide/manifold.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hapnet::scene {

/// A simple reference in long double: no memory, no shortcuts, every axis.
struct Exhaustive {
    using Vector = std::array<long double, 3>;

    static Vector vector(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

    static long double dot(const Vector& a, const Vector& b)
    {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    static Vector cross(const Vector& a, const Vector& b)
    {
        return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    }

    static long double shadow(const OrientedBox& box, const Vector& direction)
    {
        long double sum = 0.0L;
        for (const int k : {0, 1, 2})
            sum += box.half[k] * std::abs(dot(direction, vector(box.axes[k])));
        return sum;
    }

    /// The separation of the boxes along a direction.
    static long double along(const OrientedBox& a, const OrientedBox& b, const Vector& direction)
    {
        const Vector offset{static_cast<long double>(b.centre.x) - a.centre.x,
                            static_cast<long double>(b.centre.y) - a.centre.y,
                            static_cast<long double>(b.centre.z) - a.centre.z};
        return (std::abs(dot(direction, offset)) - shadow(a, direction) - shadow(b, direction)) /
               std::sqrt(dot(direction, direction));
    }

    /// The greatest distance along the 15 axes: negative when the boxes overlap.
    static long double separation(const OrientedBox& a, const OrientedBox& b)
    {
        long double most = -HUGE_VALL;
        for (const int i : {0, 1, 2}) {
            most = std::max(most, along(a, b, vector(a.axes[i])));
            most = std::max(most, along(a, b, vector(b.axes[i])));
            for (const int j : {0, 1, 2}) {
                const Vector direction = cross(vector(a.axes[i]), vector(b.axes[j]));
                if (dot(direction, direction) > 1e-18L)
                    most = std::max(most, along(a, b, direction));
            }
        }
        return most;
    }
};

/// SweptBoxes from a seed.
class BoxesDrawn {
public:
    explicit BoxesDrawn(const base::RandomStream& draw) : draw_{draw} {}

    double uniform(double low, double high) { return low + (high - low) * draw_.uniform(next_++); }

    bool one_in(std::uint64_t count)
    {
        return draw_.below(static_cast<std::uint32_t>(count), next_++) == 0;
    }

    glm::dvec3 within_cube(double half)
    {
        const double x = uniform(-half, half);
        const double y = uniform(-half, half);
        return {x, y, uniform(-half, half)};
    }

    glm::dvec3 direction()
    {
        for (;;) {
            const glm::dvec3 v = within_cube(1.0);
            const double square = v.x * v.x + v.y * v.y + v.z * v.z;
            if (square > 0.01 && square < 1.0) return v / std::sqrt(square);
        }
    }

    /// Axes turned by up to `angle`, the quaternion's vector part being uniform in a cube.
    glm::dmat3 axes(double angle)
    {
        const glm::dvec3 v = within_cube(0.5 * angle);
        const double square = v.x * v.x + v.y * v.y + v.z * v.z;
        const auto product = [&](int i, int j) { return 2.0 * v[i] * v[j] / (1.0 + square); };
        const double s = 2.0 / (1.0 + square);
        return {1.0 - product(1, 1) - product(2, 2),
                product(0, 1) + s * v.z,
                product(0, 2) - s * v.y,
                product(0, 1) - s * v.z,
                1.0 - product(0, 0) - product(2, 2),
                product(1, 2) + s * v.x,
                product(0, 2) + s * v.y,
                product(1, 2) - s * v.x,
                1.0 - product(0, 0) - product(1, 1)};
    }

    /// Half edges of a size, the longest at most `ratio` times the shortest.
    glm::dvec3 half(double size, double ratio)
    {
        const auto edge = [&] { return size * std::exp2(uniform(0.0, std::log2(ratio))); };
        const double x = edge();
        const double y = edge();
        return {x, y, edge()};
    }

    OrientedBox box(double size, double ratio)
    {
        const glm::dvec3 edges = half(size, ratio);
        return {.centre = within_cube(2.0 * size), .axes = axes(4.0), .half = edges};
    }

private:
    base::RandomStream draw_;
    std::uint64_t next_ = 0;
};

/// Two boxes that nearly touch, or overlap a little.
struct BoxPair {
    OrientedBox a;
    OrientedBox b;

    [[nodiscard]] double smallest_half() const
    {
        return std::min({a.half.x, a.half.y, a.half.z, b.half.x, b.half.y, b.half.z});
    }
};

/// `b` is pushed along a random direction until the two are `gap` (in smallest half edges) apart.
/// One in four pairs has nearly parallel axes, one in eight of them exactly parallel ones.
inline BoxPair near_pair(BoxesDrawn& drawn, double size_ratio, double gap)
{
    BoxPair pair{.a = drawn.box(0.01, 3.0), .b = drawn.box(0.01 * size_ratio, 3.0)};
    if (drawn.one_in(4)) {
        pair.b.axes = pair.a.axes;
        if (!drawn.one_in(8)) {
            const glm::dmat3 turn = drawn.axes(drawn.one_in(2) ? 1e-4 : 0.05);
            pair.b.axes = turn * pair.a.axes;
        }
    }
    const glm::dvec3 direction = drawn.direction();
    const glm::dvec3 reach = pair.a.half + pair.b.half;
    double low = 0.0;
    double high = 4.0 * (reach.x + reach.y + reach.z);
    for (int k = 0; k < 20; ++k) {
        const double centre = 0.5 * (low + high);
        pair.b.centre = pair.a.centre + centre * direction;
        const bool is_apart = Exhaustive::separation(pair.a, pair.b) > gap * pair.smallest_half();
        (is_apart ? high : low) = centre;
    }
    return pair;
}

} // namespace hapnet::scene

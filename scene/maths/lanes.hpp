// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>

namespace hapnet::scene {

/// Two doubles that are computed at once: one register of any 64-bit machine. Each has the same
/// bits as a double alone.
using Two = double __attribute__((vector_size(16)));

[[nodiscard]] inline Two both(double a) { return Two{a, a}; }
/// Loads two adjacent numbers. `from` may have any alignment.
[[nodiscard]] inline Two two_of(const double* from)
{
    Two two;
    std::memcpy(&two, from, sizeof two);
    return two;
}
inline void put_two(Two two, double* to) { std::memcpy(to, &two, sizeof two); }
[[nodiscard]] inline Two swapped(Two a) { return Two{a[1], a[0]}; }
[[nodiscard]] inline Two sizes(Two a)
{
    using Bits = std::int64_t __attribute__((vector_size(16)));
    constexpr std::int64_t all_but_sign = 0x7fffffffffffffff;
    return std::bit_cast<Two>(std::bit_cast<Bits>(a) & Bits{all_but_sign, all_but_sign});
}

/// Two vectors, component by component.
struct TwoVectors {
    Two x, y, z;
};
[[nodiscard]] inline TwoVectors both(const glm::dvec3& a)
{
    return {both(a.x), both(a.y), both(a.z)};
}
[[nodiscard]] inline TwoVectors both(const glm::dvec3& a, const glm::dvec3& b)
{
    return {Two{a.x, b.x}, Two{a.y, b.y}, Two{a.z, b.z}};
}
[[nodiscard]] inline TwoVectors operator+(const TwoVectors& a, const TwoVectors& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] inline TwoVectors operator-(const TwoVectors& a, const TwoVectors& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] inline TwoVectors operator*(const TwoVectors& a, const TwoVectors& b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
[[nodiscard]] inline TwoVectors operator*(Two a, const TwoVectors& b)
{
    return {a * b.x, a * b.y, a * b.z};
}
[[nodiscard]] inline Two dot(const TwoVectors& a, const TwoVectors& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[nodiscard]] inline TwoVectors cross(const TwoVectors& a, const TwoVectors& b)
{
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
[[nodiscard]] inline Two sum_of_sizes(const TwoVectors& a)
{
    return sizes(a.x) + sizes(a.y) + sizes(a.z);
}
[[nodiscard]] inline glm::dvec3 first(const TwoVectors& a) { return {a.x[0], a.y[0], a.z[0]}; }
[[nodiscard]] inline glm::dvec3 second(const TwoVectors& a) { return {a.x[1], a.y[1], a.z[1]}; }
[[nodiscard]] inline glm::dvec3 sum(const TwoVectors& a)
{
    return {a.x[0] + a.x[1], a.y[0] + a.y[1], a.z[0] + a.z[1]};
}

} // namespace hapnet::scene

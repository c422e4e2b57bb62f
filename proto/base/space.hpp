// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace hapnet::base {

// Positions, vectors and rotations in a right-handed frame: x right, y up, z toward the user. SI
// units: metres, seconds, newtons. The types prevent mistakes such as position + position, or a
// force in place of a displacement.

/// A free vector of one physical kind.
template <typename Kind>
struct Vector {
    glm::dvec3 value{0.0, 0.0, 0.0};

    [[nodiscard]] constexpr double x() const { return value.x; }
    [[nodiscard]] constexpr double y() const { return value.y; }
    [[nodiscard]] constexpr double z() const { return value.z; }

    friend constexpr Vector operator+(Vector a, Vector b) { return {a.value + b.value}; }
    friend constexpr Vector operator-(Vector a, Vector b) { return {a.value - b.value}; }
    friend constexpr Vector operator-(Vector a) { return {-a.value}; }
    friend constexpr Vector operator*(double s, Vector a) { return {s * a.value}; }
    constexpr Vector& operator+=(Vector b)
    {
        value += b.value;
        return *this;
    }
    friend constexpr bool operator==(const Vector& a, const Vector& b)
    {
        return a.value == b.value;
    }
};

/// Metres.
using Displacement = Vector<struct DisplacementKind>;
/// Metres per second.
using Velocity = Vector<struct VelocityKind>;
/// Newtons.
using Force = Vector<struct ForceKind>;
/// Newton seconds.
using Impulse = Vector<struct ImpulseKind>;

/// A point, in metres from the origin.
struct Position {
    glm::dvec3 value{0.0, 0.0, 0.0};

    [[nodiscard]] constexpr double x() const { return value.x; }
    [[nodiscard]] constexpr double y() const { return value.y; }
    [[nodiscard]] constexpr double z() const { return value.z; }

    friend constexpr Displacement operator-(Position a, Position b) { return {a.value - b.value}; }
    friend constexpr Position operator+(Position a, Displacement d) { return {a.value + d.value}; }
    friend constexpr Position operator-(Position a, Displacement d) { return {a.value - d.value}; }
    friend constexpr bool operator==(const Position& a, const Position& b)
    {
        return a.value == b.value;
    }
};

[[nodiscard]] constexpr Displacement operator*(Velocity v, Duration t)
{
    return {v.value * to_seconds(t)};
}
[[nodiscard]] constexpr Impulse operator*(Force f, Duration t) { return {f.value * to_seconds(t)}; }

/// Returns the length of a vector. The square root is correctly rounded, so the bits are the same
/// everywhere.
template <typename Kind>
[[nodiscard]] double norm(Vector<Kind> v)
{
    return std::sqrt(v.value.x * v.value.x + v.value.y * v.value.y + v.value.z * v.value.z);
}

[[nodiscard]] inline bool is_finite(const glm::dvec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
template <typename Kind>
[[nodiscard]] bool is_finite(Vector<Kind> v)
{
    return is_finite(v.value);
}
[[nodiscard]] inline bool is_finite(Position p) { return is_finite(p.value); }

/// Returns `v`, shortened to `length_max` if it is longer. The direction is unchanged.
template <typename Kind>
[[nodiscard]] Vector<Kind> limited(Vector<Kind> v, double length_max)
{
    const double length = norm(v);
    return length > length_max ? (length_max / length) * v : v;
}

/// Returns a rotation scaled to length 1. It uses a square root and a division, so the bits are the
/// same everywhere. glm's own function does not promise that.
[[nodiscard]] inline glm::dquat normalized(const glm::dquat& q)
{
    const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w / length, q.x / length, q.y / length, q.z / length};
}

} // namespace hapnet::base

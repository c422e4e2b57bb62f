// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace hapnet::scene {

// Rotations of rigid bodies, from + - * / and sqrt alone. An orientation maps the body's frame to
// the world's. A body that turns freely keeps its angular momentum in the world's frame. The
// momentum is the state, and the angular velocity follows from it, so that the momentum's length
// cannot drift.

/// cos(sqrt(z)) and sin(sqrt(z))/sqrt(z) for 0 <= z <= small_half_angle_max, within 2 units in the
/// last place. z is the square of half the angle of a turn of up to 90 degrees. Branch-free, for
/// loops over lanes.
struct HalfAngle {
    double cosine = 1.0;
    double sinc = 1.0;
};
inline constexpr double small_half_angle_max = 0.6168; // (pi/4)^2
[[nodiscard]] constexpr HalfAngle small_half_angle(double z)
{
    // The kernels of fdlibm (Sun Microsystems, 1993) without the corrections for reduced arguments.
    const double cosine =
        4.16666666666666019037e-02 +
        z * (-1.38888888888741095749e-03 +
             z * (2.48015872894767294178e-05 +
                  z * (-2.75573143513906633035e-07 +
                       z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))));
    const double sinc =
        -1.66666666666666324348e-01 +
        z * (8.33333333332248946124e-03 +
             z * (-1.98412698298579493134e-04 +
                  z * (2.75573137070700676789e-06 +
                       z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10))));
    return {1.0 - (0.5 * z - z * z * cosine), 1.0 + z * sinc};
}

/// As small_half_angle(), for any turn up to 2e6 radians. Above that the result is no turn at all.
[[nodiscard]] HalfAngle half_angle(double z);

/// Returns the turn by |angle| radians about the axis of `angle`.
[[nodiscard]] glm::dquat rotation_by(const glm::dvec3& angle);

/// Restores the length 1 of `q` after the rounding of a few products: one step of Newton's method.
[[nodiscard]] inline glm::dquat unit_again(const glm::dquat& q)
{
    const double scale = 1.5 - 0.5 * (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.w * scale, q.x * scale, q.y * scale, q.z * scale};
}

/// Returns the axes of a body in the world: the columns of a rotation.
[[nodiscard]] glm::dmat3 axes_of(const glm::dquat& orientation);

/// Returns the unit quaternion `orientation` after a turn by `angle` (world's frame).
[[nodiscard]] inline glm::dquat rotated(const glm::dquat& orientation, const glm::dvec3& angle)
{
    return unit_again(rotation_by(angle) * orientation);
}

/// The rotation of a body that nothing touches.
struct FreeRotation {
    glm::dvec3 angular_momentum{0.0}; // kg m^2/s, world's frame; constant
    glm::dvec3 inverse_inertia{0.0};  // about the body's own axes
};

/// Returns the spin of a freely turning body in the middle of a tick, by half an explicit step.
[[nodiscard]] glm::dvec3 mean_spin(const glm::dquat& orientation, const FreeRotation& spin,
                                   double tick);

/// Returns the shortest turn from one orientation to another: `to` is rotated(from, turn). Within
/// 1e-10.
[[nodiscard]] glm::dvec3 turn_between(const glm::dquat& from, const glm::dquat& to);

/// Returns the nearest orientation in which a body with that angular momentum has this energy of
/// rotation, J; nullopt where none is within 0.1 radians.
[[nodiscard]] std::optional<glm::dquat> with_energy(const glm::dquat& orientation,
                                                    const FreeRotation& spin, double energy);

/// Returns the orientation of a freely rotating body one tick later. It uses the explicit midpoint
/// rule on the rotation group in steps of at most 0.2 radians, and corrects each step to the
/// initial energy. That is second order; energy and angular momentum stay the same to rounding.
/// Beyond 12.8 radians in a tick the body rotates evenly about its angular momentum, which keeps
/// both as well. Exact when the three moments of inertia are equal.
[[nodiscard]] glm::dquat rotated_freely(const glm::dquat& orientation, const FreeRotation& spin,
                                        double tick);

} // namespace hapnet::scene

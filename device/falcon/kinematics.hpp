// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/falcon/packet.hpp"
#include "proto/base/space.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace hapnet::device::falcon {

// Where the grip of a Falcon is, by the angles of its three legs: the parallel arm of R. E. Stamper
// (PhD thesis, University of Maryland, 1997), with the lengths that libnifalcon gives for the
// Falcon (include/falcon/core/FalconGeometry.h). No other source for them is known.

/// Angles of the three upper arms, rad.
using Angles = glm::dvec3;

/// The frame: x right, y up, z toward the user, as libnifalcon has it; the origin is the middle of
/// the workspace, this far in front of the legs' own plane.
inline constexpr double origin_z_m = 0.115;

/// Half edge of a cube around the origin, m, that can be reached completely, with angles from -57
/// to 92 degrees (computed). CHAI3D states the same length as the Falcon's radius.
inline constexpr double reach_m = 0.040;

/// Returns the angles of the arms from encoders that were homed. One turn of a motor is 1280
/// counts; a cable drives the arm (110 mm) from the motor's shaft (14.25 mm). Counts are zero at
/// about 35 degrees.
[[nodiscard]] Angles angles_of(const Counts& encoders);
/// The nearest counts; the angles are at most 20 rad.
[[nodiscard]] Counts encoders_at(const Angles& angles);

/// Returns the angles of the arms at a place of the grip; nullopt where it cannot get there.
[[nodiscard]] std::optional<Angles> inverse(const base::Position& grip);

/// The place with these angles, by Newton's method from `near`; nullopt: there is none, or none
/// that is found from there. inverse() of it gives the angles back to 1e-9.
[[nodiscard]] std::optional<base::Position> forward(const Angles& angles,
                                                    const base::Position& near);

/// d grip / d angles, m/rad, one column for each leg; zero where the grip cannot be, and where it
/// is stretched out so far that it has none.
[[nodiscard]] glm::dmat3 jacobian(const base::Position& grip);

inline constexpr Mechanism mechanism{"falcon_torque_max", jacobian};

} // namespace hapnet::device::falcon

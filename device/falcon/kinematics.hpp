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

// The position of a Falcon's grip, from the angles of its three legs: the parallel arm of R. E.
// Stamper (PhD thesis, University of Maryland, 1997), with the lengths that libnifalcon gives for
// the Falcon (include/falcon/core/FalconGeometry.h). No other source for them is known.

/// Angles of the three upper arms, rad.
using Angles = glm::dvec3;

/// The distance of the origin, which is the middle of the workspace, in front of the plane of the
/// legs. The frame is x right, y up, z toward the user, as in libnifalcon.
inline constexpr double origin_z_m = 0.115;

/// Half edge of a cube around the origin, m, that can be reached completely, with angles from -57
/// to 92 degrees (computed). CHAI3D states the same length as the Falcon's radius.
inline constexpr double reach_m = 0.040;

/// Returns the angles of the arms from encoders that were homed. One turn of a motor is 1280
/// counts; a cable drives the arm (110 mm) from the motor's shaft (14.25 mm). Counts are zero at
/// about 35 degrees.
[[nodiscard]] Angles angles_of(const Counts& encoders);
/// Returns the nearest counts. The angles must be at most 20 rad.
[[nodiscard]] Counts encoders_at(const Angles& angles);

/// Returns the angles of the arms at a position of the grip; nullopt where the grip cannot be.
[[nodiscard]] std::optional<Angles> inverse(const base::Position& grip);

/// Returns the position with these angles, by Newton's method from `near`; nullopt: there is none,
/// or none is found from `near`. inverse() of the result gives the angles to within 1e-9.
[[nodiscard]] std::optional<base::Position> forward(const Angles& angles,
                                                    const base::Position& near);

/// Returns d grip / d angles, m/rad, one column for each leg. It is zero where the grip cannot be,
/// and where the arm is stretched so far that the Jacobian does not exist.
[[nodiscard]] glm::dmat3 jacobian(const base::Position& grip);

inline constexpr Mechanism mechanism{"falcon_torque_max", jacobian};

} // namespace hapnet::device::falcon

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "proto/base/space.hpp"

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace hapnet::device::omni {

// The PHANToM Omni's arm: a waist that turns about the vertical, an upper arm from the shoulder,
// and a forearm that is driven by a parallelogram, so that both motors are in the base and the
// forearm's angle is absolute. Frame: x right, y up, z toward the user, metres. The origin is that
// of the vendor's library, in the middle of the workspace. Lengths as usually published (Silva et
// al. 2009; Sansanayuth et al. 2012), not measured.

inline constexpr double link_m = 0.13335;   // length of each of the two links: 5.25 inches
inline constexpr double height_m = 0.02335; // distance of the origin below the shoulder's axis
inline constexpr double depth_m = 0.16835; // distance of the origin in front of the shoulder's axis

/// Angles in radians. x is the waist (positive turns the stylus to the left), y the shoulder from
/// the horizontal, z the forearm from the vertical, which is absolute.
struct Joints {
    glm::dvec3 angles{0.0};
};

/// The range of a joint, rad: of the waist, the shoulder or the elbow. The angle of the elbow is
/// the forearm's minus the shoulder's. From a published model of the arm.
struct JointRange {
    double least;
    double most;
};
inline constexpr JointRange waist_range{-0.98, 0.98};
inline constexpr JointRange shoulder_range{0.0, 1.75};
inline constexpr JointRange elbow_range{-0.81, 1.25};

/// The angles with the stylus in its inkwell, according to an open driver. The angles that the
/// vendor's library gives there agree to 0.04 rad (from memory).
inline constexpr Joints inkwell_pose{{0.0, 0.23, -0.37}};

/// The peak torque of each motor at its joint, N m: the torque for 3.3 N in every direction at the
/// origin, where the data sheet guarantees it. An estimate without a source.
inline constexpr glm::dvec3 torque_max_nm{3.3 * depth_m, 3.3 * link_m, 3.3 * link_m};

/// Figures of the data sheet.
inline constexpr glm::dvec3 half_workspace_m{0.080, 0.060, 0.035};
inline constexpr double force_max_n = 3.3;         // peak, at the origin
inline constexpr double force_continuous_n = 0.88; // bearable for 24 hours
inline constexpr double friction_n = 0.26;         // back-drive friction at the stylus
inline constexpr double tip_mass_kg = 0.045;       // apparent mass at the stylus
/// The stiffness that stays stable in the hand. It is below the 1.02 N/mm of the mechanism
/// (CHAI3D's table).
inline constexpr double stiffness_max_n_per_m = 700.0;
inline constexpr double damping_max_ns_per_m = 5.0;

/// Returns the position of the stylus.
[[nodiscard]] base::Position position_of(const Joints& joints);

/// Returns the angles that put the stylus at this position, with the elbow up. If the position is
/// out of reach, they are those of the arm stretched in its direction.
[[nodiscard]] Joints joints_of(const base::Position& position);

/// Returns d position / d angle, m/rad, a column for each joint. Torques are its transpose times
/// the force at the stylus.
[[nodiscard]] glm::dmat3 jacobian(const Joints& joints);

/// Returns the Jacobian from the position of the stylus, computed with square roots only. Finite
/// for every finite position.
[[nodiscard]] glm::dmat3 jacobian_at(const base::Position& position);

/// True if the mechanism reaches these angles, with a tolerance of `slack` radians.
[[nodiscard]] bool is_reachable(const Joints& joints, double slack = 0.0);

inline constexpr Mechanism mechanism{"omni_torque_max", jacobian_at};

} // namespace hapnet::device::omni

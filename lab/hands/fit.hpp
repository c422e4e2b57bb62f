// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/hands/motion.hpp"
#include "proto/base/result.hpp"

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::hands {

// Recorded motion is fitted into the scene as follows. One factor scales all hands of a trial. Then
// each hand is moved, without being turned. At the moment when the two hands are nearest to each
// other along x, each intends to be in the middle of its side of the cube, `press` deep in it. For
// a single hand, which acts as A, that is the moment when it is farthest to the right.

/// Half of the Omni's workspace, 160 x 120 x 70 mm, around the cube's position at the start.
inline constexpr glm::dvec3 half_workspace_m{0.080, 0.060, 0.035};
/// The distance from the middle of the paper's cube to a hand that touches its face: half an edge
/// and the radius of the HIP.
inline constexpr double touching_m = 0.025;

struct FitRules {
    std::optional<double> scale{}; // nullopt: the largest that fits, at most 1
    double press_m = 0.004;        // depth at which T3 presses with 0.571 N
    double speed_max_m_per_s = 1.0;
};

struct Fit {
    double scale = 1.0;
    /// The limit that keeps the scale from being larger: "workspace along x" or "speed". Empty:
    /// none does.
    std::string limited_by{};
    double meeting_s = 0.0; // time when the hands are nearest, from the beginning of the motion
    /// The share of the time in which the hands are near enough to touch the cube.
    double touching_share = 0.0;
};

/// Scales and moves the motions of A and, if present, of B, which are equally long. The error names
/// the limit that a given scale exceeds, or says that A is on the right of B.
[[nodiscard]] base::Result<Fit> fit(std::vector<Motion>& hands, const FitRules& rules);

} // namespace hapnet::lab::hands

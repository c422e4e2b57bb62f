// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/solver/joint_solver.hpp"
#include "scene/state.hpp"

#include <cstdint>
#include <vector>

namespace hapnet::scene {

/// The joints of a scene by their groups: those that share movable bodies stand side by side.
struct JointOrder {
    std::vector<JointId> ids;
    std::vector<JointSolver::Group> groups;
    std::vector<std::uint32_t> first; // see JointSolver
};
[[nodiscard]] JointOrder joint_order(const Description& description);

/// The pairs of bodies that joints keep from touching each other, sorted, the lower id first.
[[nodiscard]] std::vector<BodyPair> joined_apart(const Description& description);

[[nodiscard]] JointSolver joint_solver_of(const Description& description);

} // namespace hapnet::scene

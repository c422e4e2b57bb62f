// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/hip/advance.hpp"

#include <array>
#include <glm/geometric.hpp>

namespace hapnet::scene {

/// How a hand's spring acts on a body that lies as it does at some moment.
struct Hold {
    glm::dvec3 normal{0.0}; // unit, from the body to the hand
    glm::dvec3 lever{0.0};  // arm x normal
    double depth = 0.0;     // > 0: overlap
};

/// The face, edge or corner of a box that a hand's sphere is at, in the body's frame: what of a
/// contact stays while the body turns and the hand slides on. Which of them it is the normal says:
/// along the box's axes on which the normal has no part, the contact follows the hand.
class Surface {
public:
    Surface() = default;
    /// `axes` are the body's, in the world.
    Surface(const HipSpring& spring, const glm::dmat3& axes);

    /// Whether it is a face: then the normal turns with the body, and only with it.
    [[nodiscard]] bool is_face() const { return bound_ == 1; }

    /// With the hand's centre at `hand`, seen from the body's centre in the world's frame.
    [[nodiscard]] Hold at(const glm::dmat3& axes, const glm::dvec3& hand) const;

private:
    glm::dvec3 point_{0.0};
    glm::dvec3 normal_{0.0};    // at the start
    glm::dvec3 is_bound_{0.0};  // 1 on the axes on which the contact does not follow the hand
    int bound_ = 0;             // how many they are
    double radius_ = 0.0;
};

} // namespace hapnet::scene

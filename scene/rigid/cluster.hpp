// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bodies.hpp"
#include "scene/collide/manifold.hpp"
#include "scene/solver/contact_block.hpp"

#include <cstdint>

namespace hapnet::scene {

/// A body at the moment at which it becomes part of a cluster.
struct ClusterPart {
    const BodyProperties& properties;
    OrientedBox box;
    glm::dvec3 velocity{0.0};
    glm::dvec3 angular_momentum{0.0}; // about the body's centre
};

/// Movable bodies that stick together, as after an inelastic impact. The cluster has the one motion
/// of a rigid body with the bodies' momentum and angular momentum. That is the projection of the
/// bodies' motion in the metric of kinetic energy, so energy falls. Where a part is locked, the
/// cluster is locked: it keeps the momentum along its free axes. It turns only about axes that all
/// parts may turn about, and not at all when a part is locked along an axis.
///
/// First count all parts, for the mass and the centre. Then join them.
class Cluster {
public:
    void count(const ClusterPart& part);
    void join(const ClusterPart& part);
    /// Finds the one motion of all parts. Call it after all parts were joined.
    void stick();

    [[nodiscard]] const glm::dvec3& velocity() const { return velocity_; }
    [[nodiscard]] BodyMotion motion_of(const ClusterPart& part) const;
    [[nodiscard]] glm::dvec3 angular_momentum_of(const ClusterPart& part) const;
    /// Makes the cluster touch a wall that moves at `ground` and pushes it along `normal`, a unit
    /// vector. The cluster loses its speed against the wall. At a second wall it keeps, of its
    /// motion relative to that wall, only the part along both walls; at a third wall it keeps none.
    /// Returns the change of the velocity of each part.
    glm::dvec3 stick_to_wall(const glm::dvec3& normal, const glm::dvec3& ground);

private:
    double mass_ = 0.0;
    glm::dvec3 weighed_{0.0}; // sum over the parts of mass times centre
    glm::dvec3 momentum_{0.0};
    glm::dvec3 angular_momentum_{0.0}; // about the centre
    glm::dmat3 inertia_{0.0};
    glm::dvec3 free_{1.0};  // 0 along locked axes, else 1
    glm::dvec3 turns_{1.0}; // 0 about axes that the cluster does not turn about, else 1
    glm::dvec3 velocity_{0.0};
    glm::dvec3 spin_{0.0};
    std::uint32_t walls_ = 0;
    glm::dvec3 wall_{0.0}; // unit normal of the first wall, along the free axes
};

} // namespace hapnet::scene

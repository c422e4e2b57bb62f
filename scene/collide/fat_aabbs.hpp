// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/collide/aabb.hpp"
#include "scene/state.hpp"

#include <array>
#include <vector>

namespace hapnet::scene {

/// Two bodies that come nearer than this times their smallest half edges, each its own, are pairs
/// in any case: what the solver looks ahead for must be less.
inline constexpr double pair_margin = 0.05;

/// Tells which awake bodies have left the box they were given, and gives them another. A box holds
/// the body wherever its centre stays in a region around the path that it is on, and as long as it
/// turns little; a body that spins fast has a box for every orientation. So a tick compares a
/// centre with a region, and not a box with a box.
class FatAabbs {
public:
    FatAabbs(const WorldConfig& config, const Bodies& bodies);

    /// Adds the slots of the awake bodies that leave their boxes within this tick, or have.
    void find_moved_out(const Bodies& bodies, Bounded<Slot>& moved_out) const;
    /// True if the body in the slot leaves its box within this tick, or has left it.
    [[nodiscard]] bool has_moved_out(const Bodies& bodies, Slot slot) const;
    /// A new box around a body and where it is going.
    [[nodiscard]] Aabb renew(const Bodies& bodies, Slot slot);
    /// Returns the portion of a body's fat box that one of its parts needs.
    [[nodiscard]] Aabb around(const Bodies& bodies, PartId part, const Aabb& whole) const;
    /// Says that another body lies in an awake slot.
    void update_slot(const Bodies& bodies, Slot slot);

private:
    /// The region in which a body does not leave its box: along each axis, the distance of its
    /// centre from `centre`, plus the distance that it moves in a tick, is at most `room`.
    struct Bounds {
        glm::dvec3 centre{0.0};
        glm::dvec3 room{0.0};
        glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
        /// Least squared scalar product of `orientation` and the body's orientation.
        double similarity_min = -1.0;
        double angular_momentum2 = 0.0; // square of the greatest angular momentum
    };
    /// The margins that follow from a body's size, metres.
    struct Size {
        double nearby = 0.0; // pair_margin, in metres
        double stray = 0.0;  // how far the body may stray from its path
        double radius = 0.0; // distance of the corners from the centre
        double ease = 0.0;   // an upper bound of the inverse moments of inertia, 1/(kg m^2)
    };

    [[nodiscard]] Size size_of(const BodyProperties& properties) const;
    [[nodiscard]] Aabb path(const Bodies& bodies, Slot slot, double stray) const;

    double tick_;
    glm::dvec3 gravity_;
    std::vector<Bounds> bounds_; // by BodyId
    // The lanes by slot, in the order of Bounds: middle, room, orientation w x y z, likeness,
    // momentum.
    static constexpr std::size_t lanes = 12;
    std::array<std::vector<double>, lanes> lanes_;
};

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/collide/aabb.hpp"
#include "scene/state.hpp"

#include <array>
#include <vector>

namespace hapnet::scene {

/// Two bodies are always a pair when they are nearer than this times their smallest half edges,
/// each body its own. The solver must look ahead by less than that.
inline constexpr double pair_margin = 0.05;

/// Finds the awake bodies that have left their fat boxes, and gives them new ones. A box contains
/// the body as long as its centre stays in a region around its predicted path and as long as it
/// turns little. A body that spins fast has a box for every orientation. So a tick compares a
/// centre with a region and not a box with a box.
class FatAabbs {
public:
    FatAabbs(const WorldConfig& config, const Bodies& bodies);

    /// Adds the slots of the awake bodies that have left their boxes, or leave them within this
    /// tick.
    void find_moved_out(const Bodies& bodies, Bounded<Slot>& moved_out) const;
    /// True if the body in the slot leaves its box within this tick, or has left it.
    [[nodiscard]] bool has_moved_out(const Bodies& bodies, Slot slot) const;
    /// Makes a new box around a body and its predicted path, and returns it.
    [[nodiscard]] Aabb renew(const Bodies& bodies, Slot slot);
    /// Returns the portion of a body's fat box that one of its parts needs.
    [[nodiscard]] Aabb around(const Bodies& bodies, PartId part, const Aabb& whole) const;
    /// Updates the data of an awake slot after another body has moved into it.
    void update_slot(const Bodies& bodies, Slot slot);

private:
    /// The region in which a body does not leave its box: along each axis, the distance of its
    /// centre from `centre`, plus the distance that it moves in a tick, is at most `room`.
    struct Bounds {
        glm::dvec3 centre{0.0};
        glm::dvec3 room{0.0};
        glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
        /// The least squared scalar product of `orientation` and the body's orientation.
        double similarity_min = -1.0;
        double angular_momentum2 = 0.0; // square of the greatest angular momentum
    };
    /// The margins that follow from a body's size, metres.
    struct Size {
        double nearby = 0.0; // pair_margin, in metres
        double stray = 0.0;  // how far the body may stray from its predicted path
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

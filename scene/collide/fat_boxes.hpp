// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/collide/box.hpp"
#include "scene/state.hpp"

#include <array>
#include <vector>

namespace hapnet::scene {

/// Two bodies that come nearer than this times their smallest half edges, each its own, are pairs
/// in any case: what the solver looks ahead for must be less.
inline constexpr double nearby_margin = 0.05;

/// Tells which awake bodies have left the box they were given, and gives them another. A box holds
/// the body wherever its centre stays in a region around the path that it is on, and as long as it
/// turns little; a body that spins fast has a box for every orientation. So a tick compares a
/// centre with a region, and not a box with a box.
class FatBoxes {
public:
    FatBoxes(const WorldConfig& config, const Bodies& bodies);

    /// Adds the slots of the awake bodies that leave their boxes within this tick, or have.
    void find_left(const Bodies& bodies, Bounded<Slot>& left) const;
    /// A new box around a body and where it is going.
    [[nodiscard]] Box renew(const Bodies& bodies, Slot slot);
    /// Says that another body lies in an awake slot.
    void follow(const Bodies& bodies, Slot slot);

private:
    /// How far a body may go without leaving its box: its centre, with what it moves in a tick,
    /// no farther than `room` from `middle` along each axis.
    struct Leash {
        glm::dvec3 middle{0.0};
        glm::dvec3 room{0.0};
        glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
        double likeness_min = -1.0;     // of the squared scalar product of orientations
        double angular_momentum2 = 0.0; // at most, squared
    };
    /// What a body's size makes of the margins, metres.
    struct Size {
        double nearby = 0.0; // nearby_margin, in metres
        double wander = 0.0; // what it may stray from its path
        double radius = 0.0; // of its corners
        double ease = 0.0;   // an upper bound of its inverse moments of inertia, 1/(kg m^2)
    };

    [[nodiscard]] bool has_left(const Bodies& bodies, Slot slot) const;
    [[nodiscard]] Size size_of(const BodyProperties& properties) const;
    [[nodiscard]] Box path(const Bodies& bodies, Slot slot, double wander) const;

    double tick_;
    glm::dvec3 gravity_;
    std::vector<Leash> leashes_; // by id
    // By slot, in the order of Leash: middle, room, orientation w x y z, likeness, momentum.
    static constexpr std::size_t lanes = 12;
    std::array<std::vector<double>, lanes> lanes_;
};

} // namespace hapnet::scene

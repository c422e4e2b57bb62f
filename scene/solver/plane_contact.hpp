// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/box_plane.hpp"
#include "scene/solver/contact_block.hpp"

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace hapnet::scene {

/// Where a box lies over a plane.
struct BoxOverPlane {
    std::uint32_t body = 0, plane = 0; // which: their sizes and the normal never change
    const glm::dvec3& normal;
    double height = 0.0; // of the box's centre, m
    double margin = 0.0; // corners up to so high are looked at, m
    const glm::dmat3& axes;
    const glm::dquat& orientation; // that the axes are of
    const glm::dvec3& half;
    double rounding = 0.0; // see OrientedBox
};

/// A box's contact with a plane, for the solver. Mostly only the height is new: the corners are
/// those of last tick as long as the box has not turned, and the points from the pressure's centre
/// as long as last tick's impulses are those of the tick before. Both follow from what is given
/// alone, so that it does not matter of which tick they are kept: without them the bits are the
/// same.
class PlaneContact {
public:
    /// How many corners are up to the margin above the plane, or below it.
    std::uint32_t find(const BoxOverPlane& box);
    /// Whether one of them is at most so far above it.
    [[nodiscard]] bool lies_on(double within) const;
    /// Sets the block's geometry, and starts it from last tick's impulses.
    void prepare(ContactBlock& block, const ContactMemory& memory);
    /// The same for a block that prepare() has set, since when only the height is new. False, and
    /// the block is as it was, when more is.
    [[nodiscard]] bool prepare_again(ContactBlock& block, const ContactMemory& memory) const;

private:
    template <typename T>
    using Each = std::array<T, manifold_points_max>;

    /// What follows from how the box is turned. Heights are over its centre.
    struct Corners {
        std::uint32_t body = 0, plane = 0;
        glm::dvec3 normal{0.0};
        glm::dquat orientation{0.0, 0.0, 0.0, 0.0};
        Tangents tangents{glm::dvec3{0.0}, glm::dvec3{0.0}};
        Each<double> rise{}, along_1{}, along_2{};
        Each<std::uint32_t> feature{};
    };
    /// What follows from those and from last tick's impulses. The points that touch stand first.
    struct Pressure {
        std::uint32_t touching = 0; // in bits; 0: not found yet
        std::uint32_t count = 0;
        ContactMemory memory{};
        Each<double> along_1{}, along_2{}; // from the pressure's centre
        Each<std::uint32_t> feature{};
        double torsion_arm = 0.0;
        glm::dvec3 across{0.0}; // from the box's centre to the pressure's, along the plane
        double rise = 0.0;      // of the pressure's centre
        ContactImpulse impulse{};
        Wrench push{};
    };

    [[nodiscard]] bool has_pressure_of(const ContactMemory& memory) const;
    void renew(const BoxOverPlane& box);
    void renew(const ContactMemory& memory);
    void set_heights(ContactBlock& block) const;

    Corners corners_;
    Pressure pressure_;
    // Of this tick.
    double height_ = 0.0;
    std::uint32_t touching_ = 0, count_ = 0;
    Each<double> separation_{};
};

} // namespace hapnet::scene

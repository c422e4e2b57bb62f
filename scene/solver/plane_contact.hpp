// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/box_plane.hpp"
#include "scene/solver/contact_block.hpp"

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace hapnet::scene {

/// The place of a box over a plane.
struct BoxOverPlane {
    std::uint32_t body = 0, plane = 0; // indices; sizes and normal never change
    const glm::dvec3& normal;
    double height = 0.0; // height of the box's centre, m
    double margin = 0.0; // m: corners up to this height count
    const glm::dmat3& axes;
    const glm::dquat& orientation; // the orientation that has these `axes`
    const glm::dvec3& half;
    double rounding = 0.0; // see OrientedBox
};

/// A box's contact with a plane, for the solver. It keeps two results of the last tick. The corners
/// stay valid as long as the box does not turn. The points relative to the centre of pressure stay
/// valid as long as last tick's impulses equal those of the tick before. Both results follow from
/// the input alone: computing them again would give the same bits.
class PlaneContact {
public:
    /// Finds the corners that are below the plane or at most the margin above it. Returns their
    /// number.
    std::uint32_t find(const BoxOverPlane& box);
    /// True if one of the corners is at most `within` above the plane.
    [[nodiscard]] bool lies_on(double within) const;
    /// Sets the block's geometry, and starts it from last tick's impulses.
    void prepare(ContactBlock& block, const ContactMemory& memory);
    /// Updates a block that prepare() has set if only the height has changed since. Otherwise
    /// returns false and leaves the block as it was.
    [[nodiscard]] bool prepare_again(ContactBlock& block, const ContactMemory& memory) const;

private:
    template <typename T>
    using Each = std::array<T, manifold_points_max>;

    /// The geometry of the corners that follows from the box's orientation. Heights are over its
    /// centre.
    struct Corners {
        std::uint32_t body = 0, plane = 0;
        glm::dvec3 normal{0.0};
        glm::dquat orientation{0.0, 0.0, 0.0, 0.0};
        Tangents tangents{glm::dvec3{0.0}, glm::dvec3{0.0}};
        Each<double> rise{}, along_1{}, along_2{};
        Each<std::uint32_t> feature{};
    };
    /// Geometry that follows from the corners and from last tick's impulses. The points that touch
    /// come first.
    struct Pressure {
        std::uint32_t touching = 0; // touching points, one bit each; 0: not found yet
        std::uint32_t count = 0;
        ContactMemory memory{};
        Each<double> along_1{}, along_2{}; // places from the pressure's centre
        Each<std::uint32_t> feature{};
        double torsion_arm = 0.0;
        glm::dvec3 across{0.0}; // from the box's centre to the pressure's, along the plane
        double rise = 0.0;      // height of the pressure's centre over the box's centre
        ContactImpulse impulse{};
        Wrench push{};
    };

    [[nodiscard]] bool has_pressure_of(const ContactMemory& memory) const;
    void renew(const BoxOverPlane& box);
    void renew(const ContactMemory& memory);
    void set_heights(ContactBlock& block) const;

    Corners corners_;
    Pressure pressure_;
    // Values of this tick.
    double height_ = 0.0;
    std::uint32_t touching_ = 0, count_ = 0;
    Each<double> separation_{};
};

} // namespace hapnet::scene

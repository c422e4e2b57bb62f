// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/pressed_modes.hpp"
#include "scene/mass.hpp"

#include <algorithm>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <span>

namespace hapnet::scene {

/// A rigid body in the middle of a tick, in the world's frame.
struct MovingBody {
    glm::dvec3 position{0.0};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 velocity{0.0};
    glm::dvec3 angular_momentum{0.0};
};

/// The body's response to forces, and all forces on it except the hands'. They are held for the
/// tick.
struct BodyDynamics {
    glm::dvec3 half{0.0}; // half the edges of the box, on which its hands slide and turn
    glm::dvec3 inverse_mass{0.0};
    glm::dmat3 inverse_inertia{0.0}; // world's frame, at the start of the tick
    /// True if rotation does not change the inverse inertia and it is diagonal: the body is a cube,
    /// or turns about one axis only.
    bool rotates_uniformly = false;
    glm::dvec3 acceleration{0.0}; // by all forces but the hands'
    glm::dvec3 torque{0.0};       // by all torques but the hands', N m
    double drag = 0.0;            // 1/s: how fast drag takes the centre's velocity along a plane
    glm::dvec3 drag_normal{0.0};  // unit normal of the plane with drag
    double rounding = 0.0;        // m: from the core of a round body to its surface
    glm::dvec3 moments{0.0};      // moments of inertia, kg m^2, if not those of that box; else 0
};

/// A hand's spring on a body: unilateral along its normal, or in all directions when the hand holds
/// the body.
struct HandSpring {
    glm::dvec3 normal{0.0};   // unit, from the body to the hand
    glm::dvec3 arm{0.0};      // from the body's centre to the point of its surface that is pushed
    double radius = 0.0;      // radius of the hand's sphere; the contact turns about its centre
    double gap = 0.0;         // distance along the normal at the start of the tick; < 0: overlap
    glm::dvec3 velocity{0.0}; // velocity of the hand, held for the tick
    double stiffness = 0.0;
    double damping = 0.0;
    double force_max = std::numeric_limits<double>::infinity();
    // True if it presses a face (and does not grip) within nine tenths of the half edges from the
    // middle.
    bool is_amid_face = false;
    bool holds = false;             // a grip: the spring also pulls, along `stretch`
    glm::dvec3 stretch{0.0};        // from the held point to the hand; used if `holds`
    const BodyPart* part = nullptr; // the pushed part of a body of several parts
};

/// The effect of a spring in the tick.
struct SpringImpulse {
    glm::dvec3 impulse{0.0}; // on the body, N s
};

/// The energy that the springs of grips can give a body. Such springs also pull. So within a tick
/// they take and give far more energy than they pass on in the end.
struct GripEnergy {
    double impulse = 0.0; // N s: sum of the sizes of the springs' impulses
    double stored = 0.0;  // J: energy of the springs at the start
    double driven = 0.0;  // J: the work of the hands' own motion on these springs

    /// Returns the energy that these impulses can give, where `fastest` is the speed of the body's
    /// fastest corner at the start or the end of the tick. Within the tick the corner may be
    /// faster.
    [[nodiscard]] double most(double fastest) const
    {
        constexpr double within_tick = 2.0;
        return within_tick * impulse * fastest;
    }
    /// Returns the energy that the springs give besides the driven work, with a share of their
    /// impulses.
    [[nodiscard]] double given(double share, double fastest) const
    {
        return std::min(stored, share * (most(fastest) - driven));
    }
    void scale(double share)
    {
        impulse *= share;
        driven *= share;
    }
};

/// The energy that passed between a body and its hands in a tick.
struct HandEnergy {
    std::size_t rows = 0;   // rows that the midpoint rule solved
    double stored = 0.0;    // J: energy at the start in the springs on the body that do not hold
    double driven = 0.0;    // J: the work of the hands' own motion on the springs
    GripEnergy grips;       // energy of the springs that hold
    bool is_braked = false; // the springs' impulses were scaled down
};

/// Advances a body by one tick under its hands' springs and other, constant forces. There are at
/// most hands_max springs, and `work` has one entry for each. A spring that begins or ceases to act
/// within the tick does so at its exact moment.
///
/// One or two unilateral springs are oscillators in closed form. The result is exact while normals
/// and arms stay as they are, as on a body that cannot turn. While normals and arms turn, they are
/// held at their halfway values, in phases in which they turn by about a degree. That is second
/// order, and bounces keep their energy (to 1e-5 for a cube, 2e-4 for other boxes, for stiffness
/// tick^2 / mass from 0.01 to 1000). Two springs need the same ratio of damping to stiffness. For
/// more springs, springs that hold, or stiff springs with drag, the midpoint rule is used in
/// substeps. It is second order and stable however stiff the springs are.
///
/// Where a rule is not exact its outcome is checked: the hands are passive, and each spring's
/// impulse is at most what its greatest force gives in the tick (see passivity.hpp). `modes` may
/// come from any earlier tick.
HandEnergy advance(MovingBody& body, const BodyDynamics& dynamics,
                   std::span<const HandSpring> springs, std::span<SpringImpulse> work, double tick,
                   PressedModes& modes);

} // namespace hapnet::scene

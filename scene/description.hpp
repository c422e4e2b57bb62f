// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"
#include "proto/base/result.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::scene {

/// The behaviour of a surface where it touches another one. For the material of a contact see
/// combined().
struct Material {
    double friction = 0.0;    // Coulomb's coefficient, 0..friction_max
    double restitution = 0.0; // 0: no bounce, 1: elastic

    friend bool operator==(const Material&, const Material&) = default;
};

/// Returns the material of a contact: the geometric mean of both frictions, and the greater
/// restitution.
[[nodiscard]] inline Material combined(const Material& a, const Material& b)
{
    return {std::sqrt(a.friction * b.friction), std::max(a.restitution, b.restitution)};
}

/// The axes about which a body can rotate: all, none, or one axis of the world.
enum class Turning : std::uint8_t { free, locked, about_x, about_y, about_z };

constexpr auto names_of(base::Tag<Turning>)
{
    return base::names("free", "locked", "about-x", "about-y", "about-z");
}

/// The shape of a body within its box. A sphere has three equal edges. A capsule has two equal
/// edges and a longer one, along which it lies.
enum class Shape : std::uint8_t { box, sphere, capsule };

constexpr auto names_of(base::Tag<Shape>) { return base::names("box", "sphere", "capsule"); }

/// The axes of the world along which a body's centre does not move.
struct LockedAxes {
    bool x = false;
    bool y = false;
    bool z = false;

    friend bool operator==(const LockedAxes&, const LockedAxes&) = default;
};

/// The motion of a kinematic body to and fro: from its position to the position plus `by`, and
/// back. It starts and turns round at rest. Its distance from the position is by * (1 - cos(2 pi t
/// / period)) / 2.
struct Sway {
    glm::dvec3 by{0.0};      // m
    base::Duration period{}; // 0: it does not sway

    friend bool operator==(const Sway&, const Sway&) = default;
};

/// Dry friction between a hand and a surface. The hand sticks until the force along the surface
/// exceeds the first share of the force across it. Then it slides against the second share.
struct HandFriction {
    double sticking = 0.0;
    double sliding = 0.0; // at most `sticking`

    [[nodiscard]] bool is_rough() const { return sticking > 0.0; }
    friend bool operator==(const HandFriction&, const HandFriction&) = default;
};

/// Returns the friction of a hand on a surface: the geometric means of their coefficients, as with
/// two bodies.
[[nodiscard]] inline HandFriction combined(const HandFriction& a, const HandFriction& b)
{
    return {std::sqrt(a.sticking * b.sticking), std::sqrt(a.sliding * b.sliding)};
}

/// The stiffness, the damping and the coefficients of friction of a hand's spring. Where they are
/// set, they replace those of all hands. On a body, the friction replaces that of its material.
struct Feel {
    std::optional<double> stiffness_n_per_m{};
    std::optional<double> damping_ns_per_m{};
    std::optional<double> static_friction{};
    std::optional<double> dynamic_friction{};

    [[nodiscard]] bool is_own() const { return stiffness_n_per_m || damping_ns_per_m; }
    [[nodiscard]] bool has_own_friction() const { return static_friction || dynamic_friction; }
    friend bool operator==(const Feel&, const Feel&) = default;
};

/// A further part of a body: a box, a sphere or a capsule in the frame of the body's first part.
struct PartDescription {
    Shape shape = Shape::box;
    glm::dvec3 half{0.02};
    base::Position position{};                  // centre of the part, from the first part's centre
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0}; // unit, from the part's frame to the first part's

    friend bool operator==(const PartDescription&, const PartDescription&) = default;
};

/// A solid of uniform density: a box, a sphere or a capsule, or several of them in one piece. Where
/// parts overlap, the overlap has the mass of both.
struct BodyDescription {
    std::string name;
    bool movable = true;
    /// A kinematic body is not movable by forces, but it moves: with its velocity and angular
    /// velocity for ever, or as it sways, until World::drive() or World::move() changes its motion.
    /// It pushes and is not pushed.
    bool kinematic = false;
    Sway sway{};
    Shape shape = Shape::box;
    glm::dvec3 half{0.02}; // half the edges of the box, or of the box around the shape, metres
    base::Position position{};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0}; // unit, from the body's frame to the world's
    base::Velocity velocity{};
    glm::dvec3 angular_velocity{0.0}; // rad/s, in the world's frame
    double mass_kg = 0.1;
    Turning turning = Turning::free;
    LockedAxes locked{};
    Material material{};
    double drag_ns_per_m = 0.0; // viscous friction on the plane that supports it, tangential
    Feel feel{};                // for every hand on the body; takes precedence over a hand's own
    /// `position` and `orientation` are those of the first part, which `shape` and `half` describe.
    /// The first part's frame is the body's frame. The position of a body in a World is that of its
    /// centre of mass: see frame_of_mass().
    std::vector<PartDescription> parts{};

    friend bool operator==(const BodyDescription&, const BodyDescription&) = default;
};

/// A half-space that supports bodies: the work platform or a wall. Hands feel it only if `felt` is
/// set.
struct PlaneDescription {
    std::string name;
    glm::dvec3 normal{0.0, 1.0, 0.0}; // unit, out of the solid side
    double offset_m = 0.0;            // dot(normal, p) of every point p of the plane
    Material material{};
    bool felt = false; // hands feel the plane, through their own spring and damper

    friend bool operator==(const PlaneDescription&, const PlaneDescription&) = default;
};

/// A field of force in a region of space: a constant force, less the force of a damper, less the
/// pull of a spring to a point or a line. It acts on a body at its centre.
struct FieldDescription {
    std::string name;
    base::Position position{};        // the middle of the region, and where the spring pulls to
    std::optional<glm::dvec3> half{}; // half the edges of the region, m; unset: everywhere
    base::Force force{};
    double damping_ns_per_m = 0.0;
    double stiffness_n_per_m = 0.0;
    std::optional<glm::dvec3> line{}; // unit: the spring pulls to the line through `position`
    double force_limit_n = std::numeric_limits<double>::infinity();
    bool on_hands = true;
    bool on_bodies = false;

    friend bool operator==(const FieldDescription&, const FieldDescription&) = default;
};

/// The spheres of the hands (haptic interface points). All have the same values. A spring and a
/// damper act between a sphere and the surface that it touches.
struct HandDescription {
    double radius_m = 0.005;
    double stiffness_n_per_m = 500.0;
    double damping_ns_per_m = 2.0;
    double force_max_n = 3.3;    // greatest force of one contact; infinity: not limited
    double grip_reach_m = 0.005; // how near the surface a hand must be to grip
    /// Coulomb's coefficient, 0..friction_max, for sessions only: the scene reads, hashes and
    /// prints it, and the peer applies it from outside (peer::FingerFriction). The scene itself
    /// uses the two coefficients below.
    double friction = 0.0;
    std::uint32_t count = 2;                  // 0..hands_max
    double static_friction = 0.0;             // while a hand sticks, 0..friction_max
    std::optional<double> dynamic_friction{}; // while a hand slides; unset: `static_friction`

    friend bool operator==(const HandDescription&, const HandDescription&) = default;
};

/// The description of a scene before it is frozen. It is a value that any code may build, print or
/// compare.
struct Description {
    std::string name;
    std::vector<BodyDescription> bodies{}; // a body's id is its index
    std::vector<PlaneDescription> planes{};
    HandDescription hands{};
    glm::dvec3 gravity{0.0, -9.81, 0.0}; // m/s^2
    std::vector<Feel> own_hands{};       // [i] is for hand i; there may be fewer than hands
    std::vector<FieldDescription> fields{};

    friend bool operator==(const Description&, const Description&) = default;
};

inline constexpr std::uint32_t hands_max = 8;
inline constexpr std::uint32_t bodies_max = 100'000;
inline constexpr std::uint32_t planes_max = 64;
inline constexpr std::uint32_t fields_max = 64;
inline constexpr std::uint32_t parts_max = 15; // parts of a body, without the first

// The ranges of a description and of inputs. Values beyond them are refused; within them nothing
// overflows.
inline constexpr double reach_max_m = 1e3;
inline constexpr double speed_max_m_per_s = 1e4;
inline constexpr double size_min_m = 1e-4;
// A small cube that hits a wall with a corner leaves with a spin of its speed over its size. The
// limit is that of the smallest body at the greatest speed.
inline constexpr double turn_max_rad_per_s = speed_max_m_per_s / size_min_m;
inline constexpr double size_max_m = 1e2;
inline constexpr double mass_min_kg = 1e-6;
inline constexpr double mass_max_kg = 1e6;
inline constexpr double stiffness_max_n_per_m = 1e9;
inline constexpr double damping_max_ns_per_m = 1e6;
inline constexpr double force_max_n = 1e6;
inline constexpr double torque_max_n_m = 1e6;
inline constexpr double impulse_max_n_s = 1e6;
inline constexpr double friction_max = 10.0;
inline constexpr double gravity_max_m_per_s2 = 1e3;
inline constexpr base::Duration period_min{std::chrono::milliseconds{10}};
inline constexpr base::Duration period_max{std::chrono::hours{24}};

/// Returns the distance of a round body's surface from its core, m. The core of a sphere is its
/// centre; that of a capsule is a line. 0 for a box.
[[nodiscard]] double rounding_of(const BodyDescription& body);
[[nodiscard]] double rounding_of(const PartDescription& part);
/// Returns the mass of a body with a density in kg/m^3.
[[nodiscard]] double mass_of(const BodyDescription& body, double density);

/// Returns the properties of a hand's spring on a body. They come from three places in this order:
/// the body's own feel, then the hand's, then that of all hands, as CHAI3D has it.
[[nodiscard]] HandDescription hand_on(const HandDescription& hands, const Feel& own_hand,
                                      const Feel& body);

/// Returns the friction of a hand, before it is combined with that of a surface.
[[nodiscard]] HandFriction friction_of(const HandDescription& hands, const Feel& own_hand);

/// Returns the friction of a surface to hands: its own coefficients for hands, else those for
/// bodies.
[[nodiscard]] HandFriction friction_of(const Material& surface, const Feel& own = {});

/// Checks a description. The error names the part that is wrong and what was expected.
[[nodiscard]] base::Result<void> check(const Description& description);

/// Returns a hash that is equal for equal scenes on every machine. Peers refuse each other when
/// their hashes differ. Names do not count.
[[nodiscard]] std::uint64_t hash(const Description& description);

/// Returns the scene of the paper. The constants that the paper leaves open are chosen so that
/// softness grows monotonically with delay: drag >= sqrt(2 k m). The static cube stands where it
/// stops the moving one at x = 74.7 mm. It is offset in z so that it does not block the right hand.
/// The moving cube slides along x alone, so a prediction that puts it into the static cube cannot
/// push it out sideways.
[[nodiscard]] Description paper_scene();

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/manifold.hpp"
#include "scene/collide/pairs.hpp"
#include "scene/maths/energy_share.hpp"
#include "scene/maths/lanes.hpp"
#include "scene/solver/ldl.hpp"
#include "scene/solver/plane_fit.hpp"

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace hapnet::scene {

/// The response of a body to impulses. A plane, a fixed body and a sleeper do not respond.
struct BodyResponse {
    glm::dvec3 inverse_mass{0.0};
    glm::dmat3 inverse_inertia{0.0}; // world's frame
};

/// Linear and angular velocity, in the world's frame.
struct BodyMotion {
    glm::dvec3 velocity{0.0};
    glm::dvec3 spin{0.0};
    glm::dvec3 angular_impulse{0.0}; // about the centre, of all that changed `spin`: N m s
};

/// The solver's index of a body; 0 stands for everything that does not move.
using SolverIndex = std::uint32_t;

/// Six numbers of a contact in its own frame, about its anchor. The first three are along the
/// normal, about the first tangent and about the second tangent. The last three are along the first
/// tangent, along the second tangent and about the normal. Points that only push can produce the
/// first three; the others are friction.
using ContactVector = std::array<double, 6>;

/// The impulses of a contact, N s and N m s.
struct ContactImpulse {
    std::array<double, manifold_points_max> normal{};
    double tangent_1 = 0.0;
    double tangent_2 = 0.0;
    double torsion = 0.0;
};

/// An impulse in the world's frame, about the anchor.
struct Wrench {
    glm::dvec3 impulse{0.0};
    glm::dvec3 angular{0.0};
};

[[nodiscard]] inline bool is_nothing(const Wrench& push)
{
    return push.impulse == glm::dvec3{0.0} && push.angular == glm::dvec3{0.0};
}

/// Factors of a block that may be needed again. They are valid as long as the block's matrix is.
struct BlockFactors {
    Ldl<6> whole{}; // factors of the whole matrix: three or four points, and friction
    // For sets of one, two, three and four points: the set of that size that was used last, in
    // bits, or 0 for none. `few` has the factors for it and friction; `fits` has its plane.
    std::array<std::uint32_t, manifold_points_max> sets{};
    std::array<Ldl<5>, 2> few{};
    std::array<PlaneFit, 2> fits{};
    bool has_whole = false;
    bool slipped = false;   // the contact slipped when it was last solved
    double slip_step = 0.0; // step of friction per slip; 0: not known
};

/// One manifold that is solved as a whole: up to four points that push, and friction as one vector
/// and a torsion at the anchor. The anchor is the centre of pressure of the last tick.
struct ContactBlock {
    SolverIndex a = 0;
    SolverIndex b = 0;
    std::uint32_t count = 0;
    double friction = 0.0;
    double size = 0.0;        // m: the smallest half edge of the two bodies
    double torsion_arm = 0.0; // metres: ratio of the torsion's limit to the friction's limit
    glm::dvec3 normal{0.0}, tangent_1{0.0}, tangent_2{0.0};
    glm::dvec3 arm_a{0.0}, arm_b{0.0};         // from the centres to the anchor
    double rounding_a = 0.0, rounding_b = 0.0; // from the anchor to the cores of round bodies
    std::array<double, manifold_points_max> along_1{}, along_2{}; // the points from the anchor
    std::array<double, manifold_points_max> separation{};
    std::array<double, manifold_points_max> speed_min{}; // the least normal speed of each point
    std::array<std::uint32_t, manifold_points_max> feature{};
    ContactImpulse impulse;
    std::array<double, manifold_points_max> start_impulse{}; // normal impulses at the start
    Wrench start_push{};                                     // all impulses at the start
    double restitution = 0.0;
    double locked_load = 0.0;    // N s: part of the load that a lock bears; it counts for friction
    double bounce_impulse = 0.0; // N s, along the normal, of this tick
    ContactMemory* memory = nullptr; // where the impulses of this tick are kept
    /// The velocity that rotation adds to that of the contact by the end of the tick, m/s.
    ContactVector centripetal_velocity{};
    bool turns = false;       // true if centripetal_velocity adds anything
    bool is_on_plane = false; // contact with a plane: its normal never changes
    double change = 0.0;      // m/s: change of the contact's speeds by the last sweep

    bool has_matrix = false;
    Square<6> matrix{}; // from modal impulses to modal velocities
    BlockFactors factors{};

    [[nodiscard]] double normal_speed(const ContactVector& velocity, std::size_t point) const
    {
        return velocity[0] + along_2[point] * velocity[1] - along_1[point] * velocity[2];
    }
    void set_roundings(double of_a, double of_b)
    {
        rounding_a = of_a;
        rounding_b = of_b;
    }
    [[nodiscard]] double normal_sum() const
    {
        return impulse.normal[0] + impulse.normal[1] + impulse.normal[2] + impulse.normal[3];
    }
    /// Returns the largest impulse of friction, N s.
    [[nodiscard]] double friction_limit() const { return friction * (normal_sum() + locked_load); }
};

/// The ratio of a contact's torsion arm to the points' mean distance. For a face under even
/// pressure it is the mean distance from the middle of a square over the distance of its corners:
/// (sqrt(2) + log(1 + sqrt(2))) / (3 sqrt(2)).
inline constexpr double even_pressure = 0.5410;

/// Two directions in the plane of a contact, across its normal.
struct Tangents {
    glm::dvec3 first, second;
};
[[nodiscard]] Tangents tangents_of(const glm::dvec3& normal);

/// Returns last tick's impulses of the points with these features, along the given tangents.
[[nodiscard]] ContactImpulse last_impulse(std::span<const std::uint32_t> features,
                                          const Tangents& tangents, const ContactMemory& memory);

/// Sets the geometry, and starts the block from last tick's impulses.
void prepare(ContactBlock& block, const Manifold& manifold, const ContactPlaces& centres,
             const ContactMemory& memory);
/// True if the block was in balance and its memory already holds the start of the next tick: the
/// same impulses and the same normal. Counts the tick.
[[nodiscard]] inline bool keeps_impulses(const ContactBlock& block, ContactMemory& memory)
{
    if (!block.is_on_plane || block.has_matrix || memory.count != block.count) return false;
    for (std::size_t i = 0; i < manifold_points_max; ++i) {
        if (memory.feature[i] != block.feature[i]) return false;
    }
    ++memory.ticks;
    return true;
}
/// Stores the impulses as the start of the next tick, except those of an impact, which will not
/// recur. So the stored impulses at most double from tick to tick, plus `weight` (N s), which is
/// about the impulse that supports the two bodies.
void store_impulses(const ContactBlock& block, double weight, ContactMemory& memory);

/// Sets the block's impulses to zero.
void forget_impulses(ContactBlock& block);

[[nodiscard]] ContactVector velocity_at(const ContactBlock& block, const BodyMotion& a,
                                        const BodyMotion& b);
/// As velocity_at(), without friction's part.
[[nodiscard]] ContactVector normal_velocity_at(const ContactBlock& block, const BodyMotion& a,
                                               const BodyMotion& b);
/// Sets the centripetal velocity. While a body turns, its touching points move around its centre,
/// which adds to their velocity within a tick. Without this term, a box that tips over an edge
/// would gain energy. It is of second order, and is left out for bodies that turn farther than a
/// tenth of a radian. Lowers the least speeds so that a contact that stands still meets them.
void set_centripetal_velocity(ContactBlock& block, const glm::dvec3& spin_a,
                              const glm::dvec3& spin_b, double tick);

[[nodiscard]] ContactVector contact_vector(const ContactBlock& block,
                                           const ContactImpulse& impulse);

[[nodiscard]] Wrench wrench(const ContactBlock& block, const ContactVector& impulse);
/// Returns the work of an impulse on a body while the other side of the contact moves as `motion`,
/// J. `arm` starts at the other side's centre.
[[nodiscard]] double work_of(const Wrench& push, const glm::dvec3& arm, const BodyMotion& motion);
/// Returns the velocity of a point of a body. `arm` is its place from the body's centre.
[[nodiscard]] inline glm::dvec3 velocity_at(const BodyMotion& motion, const glm::dvec3& arm)
{
    return motion.velocity + glm::cross(motion.spin, arm);
}
/// Applies an impulse to one body. `arm` goes from its centre to the anchor.
void apply(const Wrench& wrench, const glm::dvec3& arm, const BodyResponse& response,
           BodyMotion& motion);

void build_matrix(ContactBlock& block, const BodyResponse& a, const BodyResponse& b);

/// Returns the change that an impulse of the contact makes to the energy of its two bodies.
/// `velocity` is that of the contact without the impulse. Needs the matrix.
[[nodiscard]] EnergyOfShare energy_of(const ContactBlock& block, const ContactVector& impulse,
                                      const ContactVector& velocity);

/// Returns the product of a block's matrix and an impulse. The matrix is symmetric, so its rows
/// serve as columns and two numbers are computed at once.
[[nodiscard]] inline ContactVector times(const Square<6>& matrix, const ContactVector& impulse)
{
    ContactVector velocity;
    for (std::size_t i = 0; i < 6; i += 2) {
        Two sum = both(impulse[0]) * two_of(&matrix[0][i]);
        for (std::size_t j = 1; j < 6; ++j) sum += both(impulse[j]) * two_of(&matrix[j][i]);
        put_two(sum, &velocity[i]);
    }
    return velocity;
}

} // namespace hapnet::scene

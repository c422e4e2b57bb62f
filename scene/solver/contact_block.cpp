// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/contact_block.hpp"

#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

/// Sets the block's points and returns their anchor: the centre of last tick's normal impulses, or
/// of all points when there are none.
glm::dvec3 set_points(ContactBlock& block, const Manifold& manifold)
{
    std::array<double, manifold_points_max> weight = block.impulse.normal;
    double sum = block.normal_sum();
    if (!(sum > 0.0)) {
        for (std::uint32_t i = 0; i < manifold.count; ++i) weight[i] = 1.0;
        sum = manifold.count;
    }
    // Sums are relative to the first point, so that a contact far from the origin loses no digits.
    const glm::dvec3 first = manifold.points[0].position;
    glm::dvec3 centre{0.0};
    for (std::uint32_t i = 1; i < manifold.count; ++i) {
        centre += weight[i] * (manifold.points[i].position - first);
    }
    const glm::dvec3 anchor = first + (1.0 / sum) * centre;
    double arm = 0.0;
    for (std::uint32_t i = 0; i < manifold.count; ++i) {
        const glm::dvec3 from = manifold.points[i].position - anchor;
        const double u = glm::dot(from, block.tangent_1);
        const double v = glm::dot(from, block.tangent_2);
        block.along_1[i] = u;
        block.along_2[i] = v;
        block.separation[i] = manifold.points[i].separation;
        arm += std::sqrt(u * u + v * v);
    }
    block.torsion_arm = even_pressure * arm / manifold.count;
    return anchor;
}

glm::dvec3 friction_impulse_of(const ContactBlock& block)
{
    return block.impulse.tangent_1 * block.tangent_1 + block.impulse.tangent_2 * block.tangent_2;
}

/// Returns the share of a tick's correction to store. A small correction also stops the speed that
/// has accumulated since the last correction. Stored as a whole it would be too large by that part
/// in the next tick, and a contact in balance would be corrected to and fro again and again. Each
/// of the ticks since then needed an equal share of it.
double share_to_keep(const ContactBlock& block, double weight, ContactMemory& memory)
{
    constexpr double small = 1e-8;
    double change = sum_of_sizes(friction_impulse_of(block) - memory.friction_impulse);
    for (std::uint32_t i = 0; i < block.count; ++i) {
        change += std::abs(block.impulse.normal[i] - block.start_impulse[i]);
    }
    constexpr double rounding = 1e-14;
    ++memory.ticks;
    if (change <= rounding * weight) return 1.0;
    const double share = change <= small * weight ? 1.0 / memory.ticks : 1.0;
    memory.ticks = 0;
    return share;
}

struct Jacobian {
    glm::dvec3 linear;
    glm::dvec3 angular;
};

// The rows that push along a direction. The other rows only turn.
constexpr std::array<std::size_t, 3> pushing_rows{0, 3, 4};

void add_body(Square<6>& matrix, const std::array<Jacobian, 6>& rows, const BodyResponse& body)
{
    Square<6> own{};
    for (const std::size_t i : pushing_rows) {
        const glm::dvec3 moved = body.inverse_mass * rows[i].linear;
        for (const std::size_t j : pushing_rows) {
            if (j <= i) own[i][j] = glm::dot(moved, rows[j].linear);
        }
    }
    for (std::size_t i = 0; i < 6; ++i) {
        const glm::dvec3 rotated = body.inverse_inertia * rows[i].angular;
        for (std::size_t j = 0; j <= i; ++j)
            matrix[i][j] += own[i][j] + glm::dot(rotated, rows[j].angular);
    }
}

std::array<Jacobian, 6> jacobian(const ContactBlock& block, const glm::dvec3& arm)
{
    const glm::dvec3 none{0.0};
    const auto push = [&](const glm::dvec3& along) {
        return Jacobian{along, glm::cross(arm, along)};
    };
    return {push(block.normal),    Jacobian{none, block.tangent_1}, Jacobian{none, block.tangent_2},
            push(block.tangent_1), push(block.tangent_2),           Jacobian{none, block.normal}};
}

// The share of a body's response along a normal, or about a lever, below which it counts as locked.
constexpr double hair = 1e-6;

/// True if a body's locks leave it almost no motion along the normal. Then it counts as locked.
/// Otherwise it would be thrown aside as by a wedge.
bool is_nearly_locked_along(const glm::dvec3& normal, const glm::dvec3& inverse_mass)
{
    const double most = std::max(inverse_mass.x, std::max(inverse_mass.y, inverse_mass.z));
    return glm::dot(normal, inverse_mass * normal) <= hair * most;
}

/// As is_nearly_locked_along(), for turning.
bool is_nearly_locked_about(const glm::dvec3& lever, const glm::dmat3& inverse_inertia)
{
    const double most = inverse_inertia[0][0] + inverse_inertia[1][1] + inverse_inertia[2][2];
    return glm::dot(lever, inverse_inertia * lever) <= hair * most * glm::dot(lever, lever);
}

} // namespace

Tangents tangents_of(const glm::dvec3& normal)
{
    const glm::dvec3& n = normal;
    // Across the axis that the normal is farthest from: the cross product is never short.
    const glm::dvec3 size = glm::abs(n);
    glm::dvec3 t{0.0};
    if (size.x <= size.y && size.x <= size.z) {
        t = {0.0, -n.z, n.y};
    } else if (size.z <= size.y) {
        t = {-n.y, n.x, 0.0};
    } else {
        t = {n.z, 0.0, -n.x};
    }
    const double square = glm::dot(t, t);
    if (square != 1.0) t = t / std::sqrt(square);
    return {t, glm::cross(n, t)};
}

ContactImpulse last_impulse(std::span<const std::uint32_t> features, const Tangents& tangents,
                            const ContactMemory& memory)
{
    ContactImpulse impulse;
    bool any = false;
    for (std::uint32_t i = 0; i < features.size(); ++i) {
        // Usually the features are the same in the same order.
        const bool is_same = i < memory.count && memory.feature[i] == features[i];
        for (std::uint32_t j = is_same ? i : 0; j < memory.count; ++j) {
            if (memory.feature[j] != features[i]) continue;
            impulse.normal[i] = memory.normal_impulse[j];
            any = any || memory.normal_impulse[j] > 0.0;
            break;
        }
    }
    if (!any) return impulse;
    impulse.tangent_1 = glm::dot(memory.friction_impulse, tangents.first);
    impulse.tangent_2 = glm::dot(memory.friction_impulse, tangents.second);
    impulse.torsion = memory.torsion_impulse;
    return impulse;
}

void prepare(ContactBlock& block, const Manifold& manifold, const ContactPlaces& centres,
             const ContactMemory& memory)
{
    block.normal = manifold.normal;
    block.count = manifold.count;
    block.has_matrix = false;
    block.is_on_plane = false;
    const Tangents tangents = tangents_of(manifold.normal);
    block.tangent_1 = tangents.first;
    block.tangent_2 = tangents.second;
    for (std::uint32_t i = 0; i < manifold.count; ++i)
        block.feature[i] = manifold.points[i].feature;
    block.impulse = last_impulse({block.feature.data(), block.count}, tangents, memory);
    block.start_impulse = block.impulse.normal;
    const glm::dvec3 anchor = set_points(block, manifold);
    block.arm_a = anchor - centres.a;
    block.arm_b = anchor - centres.b;
    block.start_push = wrench(block, contact_vector(block, block.impulse));
}

void store_impulses(const ContactBlock& block, double weight, ContactMemory& memory)
{
    const double share = share_to_keep(block, weight, memory);
    const auto kept = [share](const auto& before, const auto& now) {
        return share < 1.0 ? before + share * (now - before) : now;
    };
    memory.count = block.count;
    memory.feature = block.feature;
    for (std::uint32_t i = 0; i < block.count; ++i) {
        memory.normal_impulse[i] = kept(block.start_impulse[i], block.impulse.normal[i]);
    }
    memory.friction_impulse = kept(memory.friction_impulse, friction_impulse_of(block));
    memory.torsion_impulse = kept(memory.torsion_impulse, block.impulse.torsion);
    const double most = 2.0 * (block.start_impulse[0] + block.start_impulse[1] +
                               block.start_impulse[2] + block.start_impulse[3]) +
                        weight;
    const double sum = block.normal_sum();
    if (sum <= most) return;
    const double room = most / sum;
    for (double& impulse : memory.normal_impulse) impulse *= room;
    memory.friction_impulse *= room;
    memory.torsion_impulse *= room;
}

void forget_impulses(ContactBlock& block)
{
    block.impulse = {};
    block.start_impulse = {};
    block.start_push = {};
    block.bounce_impulse = 0.0;
}

namespace {

/// The motion of `b` relative to `a` at the contact.
struct Slip {
    glm::dvec3 velocity{0.0}, spin{0.0};
};
inline Slip slip_at(const ContactBlock& block, const BodyMotion& a, const BodyMotion& b)
{
    Slip slip;
    if (block.b != 0) slip = {b.velocity + glm::cross(b.spin, block.arm_b), b.spin};
    if (block.a != 0) {
        slip.velocity -= a.velocity + glm::cross(a.spin, block.arm_a);
        slip.spin -= a.spin;
    }
    return slip;
}

} // namespace

ContactVector velocity_at(const ContactBlock& block, const BodyMotion& a, const BodyMotion& b)
{
    const auto [velocity, spin] = slip_at(block, a, b);
    return {glm::dot(velocity, block.normal),    glm::dot(spin, block.tangent_1),
            glm::dot(spin, block.tangent_2),     glm::dot(velocity, block.tangent_1),
            glm::dot(velocity, block.tangent_2), glm::dot(spin, block.normal)};
}

ContactVector normal_velocity_at(const ContactBlock& block, const BodyMotion& a,
                                 const BodyMotion& b)
{
    const auto [velocity, spin] = slip_at(block, a, b);
    return {glm::dot(velocity, block.normal), glm::dot(spin, block.tangent_1),
            glm::dot(spin, block.tangent_2)};
}

void set_centripetal_velocity(ContactBlock& block, const glm::dvec3& spin_a,
                              const glm::dvec3& spin_b, double tick)
{
    block.centripetal_velocity = {};
    // A body hardly turns if it turns less than rounding, and less than the tolerance of a contact.
    constexpr double hardly = 1e-10; // radians
    const auto hardly_turns = [&](const glm::dvec3& spin) {
        return tick * tick * glm::dot(spin, spin) <= hardly * hardly;
    };
    block.turns = !hardly_turns(spin_a) || !hardly_turns(spin_b);
    if (!block.turns) return; // without rotation the velocity is zero
    const auto add = [&](const glm::dvec3& spin, const glm::dvec3& arm, double share) {
        // For a body that rotates far in a tick this term alone is wrong, so it fades out.
        constexpr double far = 0.1; // radians
        const double fades = tick * tick * glm::dot(spin, spin) / (far * far);
        if (fades == 0.0 || fades >= 1.0) return;
        share *= 1.0 - fades;
        // spin x (spin x at) is spin (spin at) - at spin^2, here in the contact's own axes.
        const auto in_contact = [&](const glm::dvec3& v) {
            return glm::dvec3{glm::dot(block.normal, v), glm::dot(block.tangent_1, v),
                              glm::dot(block.tangent_2, v)};
        };
        const glm::dvec3 turn = in_contact(spin);
        const glm::dvec3 at = in_contact(arm);
        const glm::dvec3 anchor = share * (glm::dot(turn, at) * turn - glm::dot(turn, turn) * at);
        block.centripetal_velocity[0] += anchor.x;
        block.centripetal_velocity[1] += share * (turn.x * turn.z);
        block.centripetal_velocity[2] -= share * (turn.x * turn.y);
        block.centripetal_velocity[3] += anchor.y;
        block.centripetal_velocity[4] += anchor.z;
    };
    // The touching point of a round body always has the same distance from its core, whichever way
    // the core turns.
    const auto core_arm = [&](const glm::dvec3& arm, double rounding) {
        return rounding != 0.0 ? arm + rounding * block.normal : arm;
    };
    if (block.b != 0) add(spin_b, core_arm(block.arm_b, block.rounding_b), tick);
    if (block.a != 0) add(spin_a, core_arm(block.arm_a, -block.rounding_a), -tick);
    // A contact that stands still meets every limit. So impulses that contradict each other, as
    // where a body is squeezed while it turns, come to an end.
    for (std::size_t i = 0; i < block.count; ++i) {
        block.speed_min[i] =
            std::min(block.speed_min[i], block.normal_speed(block.centripetal_velocity, i));
    }
}

ContactVector contact_vector(const ContactBlock& block, const ContactImpulse& impulse)
{
    ContactVector sum{0.0, 0.0, 0.0, impulse.tangent_1, impulse.tangent_2, impulse.torsion};
    for (std::size_t i = 0; i < block.count; ++i) {
        sum[0] += impulse.normal[i];
        sum[1] += block.along_2[i] * impulse.normal[i];
        sum[2] -= block.along_1[i] * impulse.normal[i];
    }
    return sum;
}

Wrench wrench(const ContactBlock& block, const ContactVector& impulse)
{
    return {impulse[0] * block.normal + impulse[3] * block.tangent_1 + impulse[4] * block.tangent_2,
            impulse[1] * block.tangent_1 + impulse[2] * block.tangent_2 +
                impulse[5] * block.normal};
}

double work_of(const Wrench& push, const glm::dvec3& arm, const BodyMotion& motion)
{
    return glm::dot(push.impulse, velocity_at(motion, arm)) + glm::dot(push.angular, motion.spin);
}

void apply(const Wrench& wrench, const glm::dvec3& arm, const BodyResponse& response,
           BodyMotion& motion)
{
    const glm::dvec3 angular = glm::cross(arm, wrench.impulse) + wrench.angular;
    motion.velocity += response.inverse_mass * wrench.impulse;
    motion.spin += response.inverse_inertia * angular;
    motion.angular_impulse += angular;
}

void build_matrix(ContactBlock& block, const BodyResponse& a, const BodyResponse& b)
{
    block.matrix = {};
    const auto rows = [&](const glm::dvec3& arm, double rounding, const BodyResponse& body) {
        std::array<Jacobian, 6> all = jacobian(block, arm);
        if (!is_nearly_locked_along(block.normal, body.inverse_mass)) return all;
        all[0].linear = glm::dvec3{0.0};
        // A push through its centre does not turn a sphere either: the rest is rounding.
        constexpr double hardly = 1e-9;
        glm::dvec3& lever = all[0].angular;
        const bool is_central =
            rounding > 0.0 && glm::dot(lever, lever) <= hardly * hardly * glm::dot(arm, arm);
        if (is_central || is_nearly_locked_about(lever, body.inverse_inertia))
            lever = glm::dvec3{0.0};
        return all;
    };
    if (block.a != 0) add_body(block.matrix, rows(block.arm_a, block.rounding_a, a), a);
    if (block.b != 0) add_body(block.matrix, rows(block.arm_b, block.rounding_b, b), b);
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = i + 1; j < 6; ++j) block.matrix[i][j] = block.matrix[j][i];
    }
    block.has_matrix = true;
    block.factors.has_whole = block.factors.slipped = false;
    block.factors.sets = {};
    block.factors.slip_step = 0.0;
}

EnergyOfShare energy_of(const ContactBlock& block, const ContactVector& impulse,
                        const ContactVector& velocity)
{
    const ContactVector change = times(block.matrix, impulse);
    EnergyOfShare energy;
    double twice = 0.0;
    for (std::size_t i = 0; i < impulse.size(); ++i) {
        energy.linear += impulse[i] * velocity[i];
        twice += impulse[i] * change[i];
    }
    energy.square = 0.5 * twice;
    return energy;
}

} // namespace hapnet::scene

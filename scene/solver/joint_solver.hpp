// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/solver/contact_block.hpp"
#include "scene/solver/envelope_ldl.hpp"
#include "scene/solver/islands.hpp"

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>
#include <vector>

namespace hapnet::scene {

/// One direction in which a joint acts: the velocity `linear (v_b - v_a) + angular_b w_b +
/// angular_a w_a` of its two bodies, and an impulse along it.
struct JointRow {
    glm::dvec3 linear{0.0}; // on b; on a the opposite
    glm::dvec3 angular_a{0.0}, angular_b{0.0};
    double target = 0.0;       // the velocity at the tick's end, less compliance times impulse
    double compliance = 0.0;   // of a spring or damper, 1/kg or 1/(kg m^2); 0: it holds
    double arm = 1.0;          // m; of a turn, what makes it a speed
    bool pushes_only = false;  // a limit: no slower than the target, and no impulse below zero
    double impulse = 0.0;      // N s or N m s, of this tick
    double way_target = 0.0;   // the mean velocity that ends where the joint holds
    double way_impulse = 0.0;  // the same as `impulse` for the mean velocity
    bool corrects_way = false; // whether there is something to correct
    bool is_active = false;    // a limit that pushes, or a row that holds
};

/// What acts between two bodies: the rows of one joint.
struct JointBlock {
    static constexpr std::size_t rows_max = 8; // five that hold, a spring, two limits
    SolverIndex a = 0;
    SolverIndex b = 0;
    std::uint32_t count = 0;
    std::array<JointRow, rows_max> rows{};
};

/// All joints of a scene. Those that share movable bodies are a group: one block of the contact
/// solver, with all its rows solved at once, by the factors L D L' within the envelope of the
/// matrix. So a chain, whatever its ratio of masses, and a closed loop are exact after one visit.
class JointSolver {
public:
    /// Joints that share movable bodies, one after the other, and how they lie in the matrix.
    struct Group {
        std::uint32_t begin = 0, end = 0; // joints
        bool is_awake = false;
    };
    enum class Mode : std::uint8_t { velocities, ways };

    JointSolver() = default;
    /// `first[i]`: the first joint that shares a movable body with joint i; or i itself.
    JointSolver(std::vector<Group> groups, std::vector<std::uint32_t> first);

    [[nodiscard]] bool is_empty() const { return groups_.empty(); }
    [[nodiscard]] std::span<Group> groups() { return groups_; }
    [[nodiscard]] std::span<const Group> groups() const { return groups_; }
    [[nodiscard]] JointBlock& joint(std::uint32_t index) { return joints_[index]; }
    [[nodiscard]] const JointBlock& joint(std::uint32_t index) const { return joints_[index]; }
    [[nodiscard]] std::span<const JointBlock> joints_of(const Group& group) const
    {
        return {&joints_[group.begin], group.end - group.begin};
    }
    [[nodiscard]] std::size_t joints() const { return joints_.size(); }
    /// A body of the group that moves.
    [[nodiscard]] SolverIndex body_of(const Group& group) const
    {
        const JointBlock& joint = joints_[group.begin];
        return joint.b != 0 ? joint.b : joint.a;
    }

    /// The velocities that a solve reads and changes.
    struct Task {
        Mode mode = Mode::velocities;
        std::span<const BodyResponse> responses;
        std::span<BodyMotion> motions;
        double tolerance = 0.0; // m/s
    };
    /// Meets the targets of all rows of a group; returns how far they were missed, m/s.
    double solve(const Group& group, const Task& task);
    /// Whether something is to be corrected of any group's way.
    [[nodiscard]] bool corrects_ways() const;

    /// Keeps the impulses of a group and brings them back, with the motions of its bodies.
    void save(const Group& group, std::span<const BodyMotion> motions);
    void restore(const Group& group, std::span<BodyMotion> motions);

private:
    struct RowRef {
        std::uint32_t joint = 0;
        std::uint32_t row = 0;
    };

    void list_rows(const Group& group, Mode mode);
    [[nodiscard]] bool choose_active(const Task& task, bool is_factored, double& miss);
    void factor(const Task& task);
    [[nodiscard]] JointRow& row(const RowRef& ref) { return joints_[ref.joint].rows[ref.row]; }
    void apply(const RowRef& ref, double impulse, const Task& task) const;

    std::vector<Group> groups_{};
    std::vector<std::uint32_t> first_{}; // by joint
    std::vector<JointBlock> joints_{};

    // Of the group at work.
    Scratch<RowRef> rows_;
    Scratch<std::uint32_t> rows_before_; // of each joint of the group: its first row
    EnvelopeLdl factors_;
    Scratch<double> answer_;

    Scratch<double> saved_impulses_;
    Scratch<BodyMotion> saved_motions_; // of both bodies of each joint
};

/// Joins the bodies of all awake groups, by solver index.
void join_joined(const JointSolver& joints, Islands& islands);

/// The velocity of a joint's row.
[[nodiscard]] inline double row_velocity(const JointBlock& joint, const JointRow& row,
                                         const BodyMotion& a, const BodyMotion& b)
{
    double sum = 0.0;
    if (joint.b != 0) sum += glm::dot(row.linear, b.velocity) + glm::dot(row.angular_b, b.spin);
    if (joint.a != 0) sum += glm::dot(row.angular_a, a.spin) - glm::dot(row.linear, a.velocity);
    return sum;
}

/// How much velocity an impulse of one adds to a row.
[[nodiscard]] double row_response(const JointBlock& joint, const JointRow& row,
                                  const BodyResponse& a, const BodyResponse& b);

} // namespace hapnet::scene

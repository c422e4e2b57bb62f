// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/joint_solver.hpp"

#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace hapnet::scene {

namespace {

// Which limits push is found by trying: so often at most. Each try leaves no limit that pulls.
constexpr std::uint32_t joint_rounds_max = 8;

// A velocity is known to so much of what it is a sum of.
constexpr double velocity_rounding = 1e-14;

std::size_t envelope_of(std::span<const std::uint32_t> first)
{
    std::size_t sum = 0;
    for (std::size_t joint = 0; joint < first.size(); ++joint)
        sum += (joint - first[joint] + 1) * JointBlock::rows_max * JointBlock::rows_max;
    return sum;
}

std::size_t joints_in_largest(std::span<const JointSolver::Group> groups)
{
    std::size_t most = 0;
    for (const JointSolver::Group& group : groups)
        most = std::max<std::size_t>(most, group.end - group.begin);
    return most;
}

/// What one row's impulse does to another row's velocity through one body.
double through_body(const BodyResponse& body, const glm::dvec3& linear, const glm::dvec3& angular,
                    const glm::dvec3& other_linear, const glm::dvec3& other_angular)
{
    return glm::dot(body.inverse_mass * linear, other_linear) +
           glm::dot(body.inverse_inertia * angular, other_angular);
}

} // namespace

double row_response(const JointBlock& joint, const JointRow& row, const BodyResponse& a,
                    const BodyResponse& b)
{
    double sum = 0.0;
    if (joint.a != 0) sum += through_body(a, row.linear, row.angular_a, row.linear, row.angular_a);
    if (joint.b != 0) sum += through_body(b, row.linear, row.angular_b, row.linear, row.angular_b);
    return sum;
}

void join_joined(const JointSolver& joints, Islands& islands)
{
    for (const JointSolver::Group& group : joints.groups()) {
        if (!group.is_awake) continue;
        for (const JointBlock& joint : joints.joints_of(group))
            if (joint.a != 0 && joint.b != 0) islands.join(joint.a, joint.b);
    }
}

JointSolver::JointSolver(std::vector<Group> groups, std::vector<std::uint32_t> first)
    : groups_{std::move(groups)}, first_{std::move(first)}, joints_(first_.size())
{
    const std::size_t rows = joints_in_largest(groups_) * JointBlock::rows_max;
    rows_ = Scratch<RowRef>{rows};
    rows_before_ = Scratch<std::uint32_t>{joints_in_largest(groups_)};
    factors_ = EnvelopeLdl{rows, envelope_of(first_)};
    answer_ = Scratch<double>{rows};
    saved_impulses_ = Scratch<double>{joints_.size() * JointBlock::rows_max};
    saved_motions_ = Scratch<BodyMotion>{2 * joints_.size()};
}

bool JointSolver::corrects_ways() const
{
    for (const Group& group : groups_) {
        if (!group.is_awake) continue;
        for (const JointBlock& joint : joints_of(group)) {
            for (std::uint32_t k = 0; k < joint.count; ++k)
                if (joint.rows[k].corrects_way) return true;
        }
    }
    return false;
}

/// Springs have no part in where a joint holds.
void JointSolver::list_rows(const Group& group, Mode mode)
{
    rows_.clear();
    rows_before_.resize(group.end - group.begin);
    for (std::uint32_t joint = group.begin; joint < group.end; ++joint) {
        rows_before_[joint - group.begin] = static_cast<std::uint32_t>(rows_.size());
        for (std::uint32_t k = 0; k < joints_[joint].count; ++k) {
            if (mode == Mode::ways && joints_[joint].rows[k].compliance > 0.0) continue;
            rows_.add() = {joint, k};
        }
    }
    const std::size_t count = rows_.size();
    answer_.resize(count);
    factors_.clear();
    for (std::uint32_t i = 0; i < count; ++i)
        factors_.add_row(rows_before_[first_[rows_[i].joint] - group.begin]);
    factors_.begin();
}

/// How far each row misses its target, into answer_. Returns whether other limits push than
/// before.
bool JointSolver::choose_active(const Task& task, bool is_factored, double& miss)
{
    bool has_changed = false;
    miss = 0.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const JointBlock& joint = joints_[rows_[i].joint];
        JointRow& its = row(rows_[i]);
        const BodyMotion& a = task.motions[joint.a];
        const BodyMotion& b = task.motions[joint.b];
        const bool is_way = task.mode == Mode::ways;
        const double target = is_way ? its.way_target : its.target;
        const double impulse = is_way ? its.way_impulse : its.impulse;
        const double given = its.compliance * impulse;
        const double left = target - given - row_velocity(joint, its, a, b);
        double size = std::abs(target) + std::abs(given);
        if (joint.a != 0)
            size += sum_of_sizes(a.velocity) * sum_of_sizes(its.linear) +
                    sum_of_sizes(a.spin) * sum_of_sizes(its.angular_a);
        if (joint.b != 0)
            size += sum_of_sizes(b.velocity) * sum_of_sizes(its.linear) +
                    sum_of_sizes(b.spin) * sum_of_sizes(its.angular_b);
        const double tolerance = task.tolerance + velocity_rounding * size * its.arm;
        const bool active = !its.pushes_only || impulse > 0.0 || left * its.arm > tolerance;
        has_changed = has_changed || active != its.is_active;
        its.is_active = active;
        answer_[i] = active ? left : 0.0;
        const double missed = std::abs(answer_[i]) * its.arm;
        const bool is_left_out = is_factored && active && factors_.is_left_out(i);
        if (missed > tolerance && !is_left_out) miss = std::max(miss, missed);
    }
    return has_changed;
}

double JointSolver::solve(const Group& group, const Task& task)
{
    list_rows(group, task.mode);
    double first_miss = 0.0;
    for (std::uint32_t round = 0; round < joint_rounds_max; ++round) {
        double miss = 0.0;
        const bool has_changed = choose_active(task, round > 0, miss);
        if (miss == 0.0) break;
        first_miss = std::max(first_miss, miss);
        if (has_changed || round == 0) factor(task);
        factors_.solve(answer_.all());
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            JointRow& its = row(rows_[i]);
            double& sum = task.mode == Mode::ways ? its.way_impulse : its.impulse;
            const double before = sum;
            sum += answer_[i];
            if (its.pushes_only) sum = std::max(sum, 0.0);
            if (sum != before) apply(rows_[i], sum - before, task);
        }
    }
    return first_miss;
}

void JointSolver::apply(const RowRef& ref, double impulse, const Task& task) const
{
    const JointBlock& joint = joints_[ref.joint];
    const JointRow& its = joint.rows[ref.row];
    const auto push = [&](SolverIndex body, const glm::dvec3& linear, const glm::dvec3& angular) {
        if (body == 0) return;
        const BodyResponse& response = task.responses[body];
        BodyMotion& motion = task.motions[body];
        motion.velocity += response.inverse_mass * linear;
        motion.spin += response.inverse_inertia * angular;
        motion.angular_impulse += angular;
    };
    push(joint.a, -impulse * its.linear, impulse * its.angular_a);
    push(joint.b, impulse * its.linear, impulse * its.angular_b);
}

/// Rows that are not active, or depend on those before them, are left out.
void JointSolver::factor(const Task& task)
{
    const auto entry = [&](std::size_t i, std::size_t j) {
        const JointBlock& one = joints_[rows_[i].joint];
        const JointBlock& other = joints_[rows_[j].joint];
        const JointRow& p = one.rows[rows_[i].row];
        const JointRow& q = other.rows[rows_[j].row];
        double sum = 0.0;
        if (one.a != 0 && one.a == other.a)
            sum +=
                through_body(task.responses[one.a], p.linear, p.angular_a, q.linear, q.angular_a);
        if (one.b != 0 && one.b == other.b)
            sum +=
                through_body(task.responses[one.b], p.linear, p.angular_b, q.linear, q.angular_b);
        if (one.a != 0 && one.a == other.b)
            sum +=
                through_body(task.responses[one.a], -p.linear, p.angular_a, q.linear, q.angular_b);
        if (one.b != 0 && one.b == other.a)
            sum +=
                through_body(task.responses[one.b], p.linear, p.angular_b, -q.linear, q.angular_a);
        return sum;
    };
    for (std::uint32_t i = 0; i < rows_.size(); ++i) {
        const JointRow& its = row(rows_[i]);
        if (!its.is_active) {
            factors_.leave_out(i);
            continue;
        }
        double* const lower = factors_.row(i);
        const std::uint32_t first = factors_.first(i);
        for (std::uint32_t j = first; j < i; ++j)
            lower[j - first] = factors_.is_left_out(j) ? 0.0 : entry(i, j);
        factors_.factor(i, entry(i, i) + (task.mode == Mode::ways ? 0.0 : its.compliance));
    }
}

void JointSolver::save(const Group& group, std::span<const BodyMotion> motions)
{
    saved_impulses_.resize(joints_.size() * JointBlock::rows_max);
    saved_motions_.resize(2 * joints_.size());
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
        const JointBlock& joint = joints_[i];
        for (std::uint32_t k = 0; k < joint.count; ++k)
            saved_impulses_[i * JointBlock::rows_max + k] = joint.rows[k].impulse;
        saved_motions_[std::size_t{2} * i] = motions[joint.a];
        saved_motions_[std::size_t{2} * i + 1] = motions[joint.b];
    }
}

void JointSolver::restore(const Group& group, std::span<BodyMotion> motions)
{
    for (std::uint32_t i = group.begin; i < group.end; ++i) {
        JointBlock& joint = joints_[i];
        for (std::uint32_t k = 0; k < joint.count; ++k)
            joint.rows[k].impulse = saved_impulses_[i * JointBlock::rows_max + k];
        motions[joint.a] = saved_motions_[std::size_t{2} * i];
        motions[joint.b] = saved_motions_[std::size_t{2} * i + 1];
    }
}

} // namespace hapnet::scene

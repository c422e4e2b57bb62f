// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// How joints that have come apart go together again: by the ways of their bodies, without a change
// of velocity.
#include "scene/maths/vector.hpp"
#include "scene/rigid/joints.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

// What is corrected in one tick, at most: of the smallest half edge, as of overlaps; and radians.
constexpr double joint_correction_max = 0.1;
constexpr double turn_correction_max = 0.1;
constexpr double corrected_turn_max = 0.5; // of a body, by all that hold it
// What is less than this share of the smallest half edge is left alone.
constexpr double joint_tolerance = 1e-10;

} // namespace

void Joints::set_way_targets(const WorldState& state, ContactSolver& solver,
                             std::span<const BodyIntegration> integrations)
{
    JointSolver& joints = solver.joints();
    ways_.clear();
    const auto pose_at_end = [&](std::optional<BodyId> body, SolverIndex index) {
        if (index == 0) return pose_of(state.bodies, body);
        const auto [centre, orientation] = placement_at_end(
            integrations[index], state.bodies, index - 1, solver.mean_motion(index), scales_.tick);
        return Pose{centre, orientation};
    };
    const double most = joint_correction_max * scales_.size;
    const double tolerance = joint_tolerance * scales_.size;
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const JointSolver::Group& group = joints.groups()[g];
        way_begins_[g] = static_cast<std::uint32_t>(ways_.size());
        way_begins_[g + 1] = way_begins_[g];
        if (!group.is_awake) continue;
        for (const BodyId body : bodies_of(g)) {
            const SolverIndex index = state.bodies.slot_of[body] + 1;
            ways_.add() = {index, solver.mean_motion(index)};
        }
        way_begins_[g + 1] = static_cast<std::uint32_t>(ways_.size());
        for (std::uint32_t i = group.begin; i < group.end; ++i) {
            const Form& form = joints_[i];
            JointBlock& block = joints.joint(i);
            if (block.count == 0) continue;
            const Place end = place_of(form, pose_at_end(form.description.to, block.a),
                                       pose_at_end(form.description.body, block.b));
            const double coordinate = coordinate_of(form, end, memories_[i].coordinate);
            const auto correct = [&](JointRow& row, double miss) {
                const bool turns = row.linear == glm::dvec3{0.0};
                const double bound = turns ? turn_correction_max : most;
                const double now = row_velocity(block, row, solver.mean_motion(block.a),
                                                solver.mean_motion(block.b));
                row.way_target = now - scales_.rate * std::clamp(miss, -bound, bound);
                row.corrects_way =
                    row.pushes_only ? miss < -tolerance : std::abs(miss) * row.arm > tolerance;
            };
            for (std::uint32_t k = 0; k < form.holding; ++k)
                correct(block.rows[k], miss_of(form, end, k));
            std::uint32_t next = form.limits_begin();
            if (form.description.lowest)
                correct(block.rows[next++], coordinate - *form.description.lowest);
            if (form.description.highest)
                correct(block.rows[next++], *form.description.highest - coordinate);
        }
    }
}

void Joints::bound_ways(ContactSolver& solver) const
{
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const auto ways = ways_.all().subspan(way_begins_[g], way_begins_[g + 1] - way_begins_[g]);
        double most = 0.0; // of what may be
        for (const Way& way : ways) {
            const BodyMotion& now = solver.mean_motion(way.body);
            most = std::max({most, length(now.velocity - way.mean.velocity) / scales_.size,
                             length(now.spin - way.mean.spin) / corrected_turn_max});
        }
        most *= scales_.tick;
        if (most <= 1.0) continue;
        const double share = 1.0 / most;
        for (const Way& way : ways) {
            BodyMotion& now = solver.mean_motion(way.body);
            const auto part = [share](const glm::dvec3& from, const glm::dvec3& to) {
                return from + share * (to - from);
            };
            now = {part(way.mean.velocity, now.velocity), part(way.mean.spin, now.spin),
                   part(way.mean.angular_impulse, now.angular_impulse)};
        }
    }
}

} // namespace hapnet::scene

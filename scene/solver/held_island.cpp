// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/held_island.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

constexpr std::size_t rows_per_block = 6;

// The limits of one solution: a number of blocks, and for each block a number of steps of its
// factors, which are the squares of the lengths of its rows. A stack takes 450, a body under four
// others 1800. More would cost more than six sweeps.
constexpr std::size_t blocks_held_max = 32;
constexpr std::size_t work_per_block_max = 2000;

/// Returns the greatest number of entries that rows can have while the squares of their lengths are
/// within the limit of work (Cauchy, Schwarz), or the number of all entries if that is less.
std::size_t entries_max(std::size_t blocks)
{
    const std::size_t rows = rows_per_block * blocks;
    const auto work = static_cast<double>(work_per_block_max * blocks * rows);
    return std::min(rows * (rows - 1) / 2, static_cast<std::size_t>(std::sqrt(work)) + 1);
}

PointSet pushing(const ContactBlock& block)
{
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < manifold_points_max; ++i)
        bits |= static_cast<std::uint32_t>(block.impulse.normal[i] > 0.0) << i;
    return PointSet::of(bits);
}

double scaled_torsion(const ContactBlock& block, double torsion)
{
    return block.torsion_arm > 0.0 ? torsion / block.torsion_arm : 0.0;
}

/// True if friction is within a share of its limit.
bool sticks(const ContactBlock& block, const ContactImpulse& impulse, double share)
{
    const double sum =
        impulse.normal[0] + impulse.normal[1] + impulse.normal[2] + impulse.normal[3];
    const double torsion = scaled_torsion(block, impulse.torsion);
    const double limit = share * block.friction * sum;
    return impulse.tangent_1 * impulse.tangent_1 + impulse.tangent_2 * impulse.tangent_2 +
               torsion * torsion <
           limit * limit;
}

/// True if impulses do not move the body, as with a kinematic one.
bool is_unmoved(const BodyResponse& response)
{
    return response.inverse_mass == glm::dvec3{0.0} && response.inverse_inertia == glm::dmat3{0.0};
}

/// Returns the change of one block's velocity by an impulse of another, through the bodies of both.
ContactVector response_of(const ContactBlock& to, const ContactBlock& from, const Wrench& push,
                          std::span<const BodyResponse> responses)
{
    BodyMotion a, b;
    const auto through = [&](SolverIndex body, const glm::dvec3& arm, double sign) {
        if (body == 0 || (body != to.a && body != to.b)) return;
        apply({sign * push.impulse, sign * push.angular}, arm, responses[body],
              body == to.a ? a : b);
    };
    through(from.a, from.arm_a, -1.0);
    through(from.b, from.arm_b, 1.0);
    return velocity_at(to, a, b);
}

} // namespace

HeldIsland::HeldIsland(std::size_t bodies, std::size_t blocks)
    : holding_{std::min(blocks, blocks_held_max)},
      first_of_body_{bodies + 1},
      factors_{rows_per_block * std::min(blocks, blocks_held_max),
               entries_max(std::min(blocks, blocks_held_max))},
      answer_{rows_per_block * std::min(blocks, blocks_held_max)},
      impulses_{std::min(blocks, blocks_held_max)}
{}

bool HeldIsland::begin(const Task& task)
{
    constexpr std::uint32_t none = ~0U;
    constexpr double surely = 1.0 - 1e-9; // a contact that slips is at its limit, up to rounding
    std::size_t work = 0;
    if (task.island.size() > blocks_held_max) return false;
    holding_.clear();
    factors_.clear();
    first_of_body_.resize(task.responses.size());
    for (const std::uint32_t i : task.island)
        first_of_body_[task.blocks[i].a] = first_of_body_[task.blocks[i].b] = none;
    first_of_body_[0] = none;
    for (const std::uint32_t i : task.island) {
        const ContactBlock& block = task.blocks[i];
        const PointSet& set = pushing(block);
        if (set.count == 0) continue;
        if (set.count < 3 || !sticks(block, block.impulse, surely)) return false;
        const auto row = static_cast<std::uint32_t>(factors_.rows());
        Holding& holding = holding_.add();
        holding = {i, row, PlaneFit{block.along_1, block.along_2, set}};
        if (holding.fit.is_flat()) return false;
        std::uint32_t first = row;
        for (const SolverIndex body : {block.a, block.b}) {
            if (body == 0 || is_unmoved(task.responses[body])) continue;
            first_of_body_[body] = std::min(first_of_body_[body], row);
            first = std::min(first, first_of_body_[body]);
        }
        for (std::size_t k = 0; k < rows_per_block; ++k) {
            factors_.add_row(first);
            work += (row + k - first) * (row + k - first);
        }
    }
    return !holding_.all().empty() && work <= work_per_block_max * holding_.size();
}

bool HeldIsland::solve(const Task& task)
{
    factors_.begin();
    answer_.resize(factors_.rows());
    factor(task);
    miss(task);
    factors_.solve(answer_.all());
    return take(task);
}

void HeldIsland::factor(const Task& task)
{
    for (const Holding& its : holding_.all()) {
        ContactBlock& block = task.blocks[its.block];
        if (!block.has_matrix)
            build_matrix(block, task.responses[block.a], task.responses[block.b]);
        const std::uint32_t first = factors_.first(its.row);
        for (const Holding& other : holding_.all()) {
            if (other.row >= its.row) break;
            if (other.row < first) continue;
            const ContactBlock& from = task.blocks[other.block];
            for (std::size_t k = 0; k < rows_per_block; ++k) {
                ContactVector unit{};
                unit[k] = 1.0;
                const ContactVector response =
                    response_of(block, from, wrench(from, unit), task.responses);
                for (std::size_t i = 0; i < rows_per_block; ++i)
                    factors_.row(its.row + i)[other.row + k - first] = response[i];
            }
        }
        for (std::size_t i = 0; i < rows_per_block; ++i) {
            double* const own = factors_.row(its.row + i) + (its.row - first);
            for (std::size_t k = 0; k < i; ++k) own[k] = block.matrix[i][k];
            factors_.factor(its.row + i, block.matrix[i][i]);
        }
    }
}

/// Finds the errors of the velocities.
void HeldIsland::miss(const Task& task)
{
    for (const Holding& its : holding_.all()) {
        const ContactBlock& block = task.blocks[its.block];
        ContactVector velocity = velocity_at(block, task.motions[block.a], task.motions[block.b]);
        if (block.turns) {
            for (std::size_t i = 0; i < 5; ++i) velocity[i] += block.centripetal_velocity[i];
        }
        const std::array<double, 3> least = its.fit.modal_least(block.speed_min);
        for (std::size_t i = 0; i < rows_per_block; ++i)
            answer_[its.row + i] = (i < least.size() ? least[i] : 0.0) - velocity[i];
    }
}

bool HeldIsland::take(const Task& task)
{
    impulses_.resize(task.island.size());
    const Holding* its = &holding_[0];
    const Holding* const end = its + holding_.size();
    for (std::size_t i = 0; i < task.island.size(); ++i) {
        const ContactBlock& block = task.blocks[task.island[i]];
        impulses_[i] = {};
        if (its == end || its->block != task.island[i]) continue;
        ContactVector now = contact_vector(block, block.impulse);
        for (std::size_t k = 0; k < rows_per_block; ++k) now[k] += answer_[its->row + k];
        ContactImpulse& impulse = impulses_[i];
        its->fit.spread({now[0], now[1], now[2]}, impulse.normal);
        impulse.tangent_1 = now[3];
        impulse.tangent_2 = now[4];
        impulse.torsion = block.torsion_arm > 0.0 ? now[5] : 0.0;
        for (const std::uint8_t point : its->fit.set().at) {
            if (impulse.normal[point] < 0.0) return false;
        }
        if (!sticks(block, impulse, 1.0)) return false;
        ++its;
    }
    return true;
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/contact_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hapnet::scene {

namespace {

/// The number of impulses of a block, all in N s.
constexpr std::size_t numbers_per_block = 7;

// Islands larger than this are swept without mixing, as their budget is used up before mixing
// helps.
constexpr std::size_t mixed_max = 1024;

// The cost of a HeldIsland, in sweeps.
constexpr std::uint32_t held_sweeps = 6;

void read(const ContactBlock& block, const ContactImpulse& impulse, double* to)
{
    for (std::size_t i = 0; i < manifold_points_max; ++i) to[i] = impulse.normal[i];
    to[4] = impulse.tangent_1;
    to[5] = impulse.tangent_2;
    to[6] = block.torsion_arm > 0.0 ? impulse.torsion / block.torsion_arm : 0.0;
}

void write(ContactBlock& block, const double* from)
{
    ContactImpulse& impulse = block.impulse;
    for (std::size_t i = 0; i < manifold_points_max; ++i) impulse.normal[i] = from[i];
    impulse.tangent_1 = from[4];
    impulse.tangent_2 = from[5];
    if (block.torsion_arm > 0.0) impulse.torsion = from[6] * block.torsion_arm;
}

/// Returns the sum of square(i). Use it only to compare one sum with another: nothing may depend on
/// its last digits, because it is added up in four parts side by side.
template <typename Square>
double sum_of(std::size_t size, Square square)
{
    std::array<double, 4> sums{};
    std::size_t i = 0;
    for (; i + sums.size() <= size; i += sums.size()) {
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += square(i + k);
    }
    for (; i < size; ++i) sums[0] += square(i);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

double size2(std::span<const double> a)
{
    return sum_of(a.size(), [&](std::size_t i) { return a[i] * a[i]; });
}

double distance2(std::span<const double> a, std::span<const double> b)
{
    return sum_of(a.size(), [&](std::size_t i) { return (a[i] - b[i]) * (a[i] - b[i]); });
}

} // namespace

ContactSolver::ContactSolver(std::size_t bodies, std::size_t blocks)
    : responses_{bodies + 1},
      end_motions_{bodies + 1},
      mean_motions_{bodies + 1},
      blocks_{blocks},
      bodies_max_{bodies},
      blocks_max_{blocks},
      contacts_{bodies + 1},
      islands_{bodies + 1},
      starts_{bodies + 2},
      order_{blocks},
      before_{numbers_per_block * std::min(blocks, mixed_max)},
      after_{numbers_per_block * std::min(blocks, mixed_max)},
      good_{numbers_per_block * std::min(blocks, mixed_max)},
      saved_{bodies + 1},
      anderson_{numbers_per_block * std::min(blocks, mixed_max)},
      held_{bodies, blocks}
{}

/// The bound is the first sweep, and then for each island either its share or the minimum number of
/// sweeps.
std::uint64_t ContactSolver::visits_bound(const SolverLimits& limits) const
{
    const std::uint64_t any = limits.sweeps_min * blocks_max_;
    const std::uint64_t all = std::uint64_t{limits.sweeps_max} * blocks_max_;
    return blocks_max_ + std::min(all, std::max<std::uint64_t>(any, limits.visits_max));
}

void ContactSolver::begin(std::size_t bodies, std::size_t kinematic)
{
    const std::size_t all = bodies + kinematic + 1;
    responding_ = static_cast<SolverIndex>(bodies);
    responses_.resize(all);
    end_motions_.resize(all);
    mean_motions_.resize(all);
    blocks_.clear();
}

SolverOutcome ContactSolver::solve_velocities(const SolverLimits& limits)
{
    return run({Mode::contacts, end_motions_.all(), limits});
}

SolverOutcome ContactSolver::solve_velocities_anew(const SolverLimits& limits,
                                                   std::span<const std::uint8_t> picked)
{
    const Task task{Mode::contacts, end_motions_.all(), limits};
    count_contacts();
    find_islands();
    SolverOutcome outcome{.sweeps = 1, .in_balance = false};
    for (ContactBlock& block : blocks_.all()) {
        block.change = 0.0;
        if (picked[responding_of(block)] == 0) continue;
        const bool has_no_other = is_alone(block);
        block.change =
            solve_block(block, task, has_no_other ? Effort::full : Effort::one_iteration);
        ++outcome.visits;
    }
    const SolverOutcome rest = run_islands(task);
    outcome.visits += rest.visits;
    outcome.change = rest.change;
    return outcome;
}

SolverOutcome ContactSolver::correct_positions(const SolverLimits& limits)
{
    const auto overlaps_now = [&](const ContactBlock& block) {
        ContactVector velocity =
            normal_velocity_at(block, mean_motions_[block.a], mean_motions_[block.b]);
        if (block.turns) {
            for (std::size_t i = 0; i < 3; ++i) velocity[i] += block.centripetal_velocity[i];
        }
        return overlaps(block, velocity, limits);
    };
    const std::span<ContactBlock> blocks = blocks_.all();
    if (std::none_of(blocks.begin(), blocks.end(), overlaps_now)) return {};
    // The new part of the impulses counts half in the mean velocities, as a force's would. For an
    // impact it should count whole, from its moment on: a good start.
    for (ContactBlock& block : blocks) {
        ContactImpulse start;
        for (std::size_t i = 0; i < block.count; ++i) {
            start.normal[i] =
                std::max(0.0, 0.5 * (block.impulse.normal[i] - block.start_impulse[i]));
        }
        block.impulse = start;
        apply(block, contact_vector(block, start), mean_motions_.all());
    }
    return run({Mode::positions, mean_motions_.all(), limits});
}

SolverOutcome ContactSolver::correct_positions_again(const SolverLimits& limits)
{
    for (ContactBlock& block : blocks_.all()) {
        block.impulse = {};
        block.has_matrix = false;
    }
    return run({Mode::positions, mean_motions_.all(), limits});
}

SolverOutcome ContactSolver::run(const Task& task)
{
    SolverOutcome outcome{.sweeps = 1};
    const bool is_only_one = blocks_.size() == 1;
    if (!is_only_one) count_contacts();
    for (ContactBlock& block : blocks_.all()) {
        const bool has_no_other = is_only_one || is_alone(block);
        block.change =
            solve_block(block, task, has_no_other ? Effort::full : Effort::one_iteration);
        outcome.change = std::max(outcome.change, block.change);
    }
    outcome.visits = blocks_.size();
    outcome.in_balance = outcome.change <= task.limits.converged;
    if (outcome.in_balance || blocks_.size() < 2) return outcome;
    find_islands();
    const SolverOutcome rest = run_islands(task);
    outcome.sweeps = rest.sweeps;
    outcome.visits += rest.visits;
    outcome.change = rest.change;
    return outcome;
}

/// Solves the islands that still move. They share the visits evenly.
SolverOutcome ContactSolver::run_islands(const Task& task)
{
    SolverOutcome outcome{.sweeps = 1};
    std::size_t moving = 0;
    for_moving_islands(task, [&](Island island) { moving += island.size(); });
    const std::size_t share = task.limits.visits_max / std::max<std::size_t>(moving, 1);
    Task its = task;
    its.limits.sweeps_max = std::min(
        its.limits.sweeps_max, std::max(its.limits.sweeps_min, static_cast<std::uint32_t>(share)));
    for_moving_islands(task, [&](Island island) {
        const SolverOutcome one = run_island(its, island);
        outcome.sweeps = std::max(outcome.sweeps, one.sweeps);
        outcome.visits += (one.sweeps - 1) * island.size();
        outcome.change = std::max(outcome.change, one.change);
    });
    return outcome;
}

/// Calls act(island) for the islands that the first sweep has not solved.
template <typename Do>
void ContactSolver::for_moving_islands(const Task& task, Do&& act)
{
    const auto moves = [&](std::uint32_t i) { return blocks_[i].change > task.limits.converged; };
    std::uint32_t begin = 0;
    for (const std::uint32_t end : starts_.all()) {
        const Island island = order_.all().subspan(begin, end - begin);
        begin = end;
        if (island.size() > 1 && std::any_of(island.begin(), island.end(), moves)) act(island);
    }
}

SolverOutcome ContactSolver::run_unmixed(const Task& task, Island island)
{
    SolverOutcome outcome{.sweeps = 1};
    while (outcome.sweeps + 2 <= task.limits.sweeps_max) {
        outcome.change = sweep(task, island);
        outcome.sweeps += 2;
        if (outcome.change <= task.limits.converged) break;
    }
    return outcome;
}

SolverOutcome ContactSolver::run_island(const Task& task, Island island)
{
    SolverOutcome outcome{.sweeps = 1};
    if (island.size() > mixed_max) return run_unmixed(task, island);
    before_.resize(numbers_per_block * island.size());
    after_.resize(numbers_per_block * island.size());
    good_.resize(numbers_per_block * island.size());
    anderson_.begin(numbers_per_block * island.size());
    read_impulses(island, before_.all());
    double shortest2 = std::numeric_limits<double>::infinity();
    double first2 = -1.0;
    bool has_jumped = false;
    bool has_tried_to_hold = false;
    while (outcome.sweeps + 2 <= task.limits.sweeps_max) {
        outcome.change = sweep(task, island);
        outcome.sweeps += 2;
        if (outcome.change <= task.limits.converged) break;
        read_impulses(island, after_.all());
        if (first2 < 0.0) first2 = size2(after_.all());
        const double step2 = distance2(before_.all(), after_.all());
        // A mixture that makes the result worse, because a contact opens or slips, is undone.
        constexpr double astray = 4.0;
        if (has_jumped && !(step2 <= astray * shortest2)) {
            undo_mixture(task, island);
            anderson_.begin(numbers_per_block * island.size());
            std::copy(good_.all().begin(), good_.all().end(), before_.all().begin());
            has_jumped = false;
            continue;
        }
        shortest2 = std::min(shortest2, step2);
        if (outcome.sweeps + 2 > task.limits.sweeps_max) break;
        // The next pair of sweeps checks the result, as it checks a mixture. If it is worse, one
        // more pair of sweeps follows.
        if (!has_tried_to_hold && outcome.sweeps + held_sweeps + 4 <= task.limits.sweeps_max &&
            may_hold(task, island)) {
            has_tried_to_hold = true;
            outcome.sweeps += held_sweeps;
            if (held_.solve(held_task(task, island))) {
                take_held(task, island);
                has_jumped = true;
                continue;
            }
        }
        has_jumped = anderson_.mix(before_.all(), after_.all(), before_.all());
        // Where bodies are wedged, impulses without effect could grow without end.
        constexpr double too_far = 1e4;
        if (!(size2(before_.all()) <= too_far * too_far * first2)) {
            std::copy(after_.all().begin(), after_.all().end(), before_.all().begin());
            anderson_.begin(numbers_per_block * island.size());
            has_jumped = false;
        }
        if (has_jumped) take_mixture(task, island);
    }
    return outcome;
}

/// Solves the blocks of an island once in order and once in reverse order. Returns the largest
/// change of a contact's speed, as in SolverOutcome.
double ContactSolver::sweep(const Task& task, Island island)
{
    double change = 0.0;
    for (const std::uint32_t i : island)
        change = std::max(change, solve_block(blocks_[i], task, Effort::one_iteration));
    for (std::size_t i = island.size(); i-- > 0;) {
        change = std::max(change, solve_block(blocks_[island[i]], task, Effort::one_iteration));
    }
    return change;
}

void ContactSolver::read_impulses(Island island, std::span<double> impulses) const
{
    for (std::size_t i = 0; i < island.size(); ++i)
        read(blocks_[island[i]], blocks_[island[i]].impulse, &impulses[numbers_per_block * i]);
}

HeldIsland::Task ContactSolver::held_task(const Task& task, Island island)
{
    return {blocks_.all(), island, responses_.all(), task.motions};
}

/// True if the equations of HeldIsland can be set up for this island.
bool ContactSolver::may_hold(const Task& task, Island island)
{
    return task.mode == Mode::contacts && held_.begin(held_task(task, island));
}

/// Changes the blocks' impulses from those in after_ to the result of HeldIsland.
void ContactSolver::take_held(const Task& task, Island island)
{
    for (std::size_t i = 0; i < island.size(); ++i)
        read(blocks_[island[i]], held_.impulses()[i], &before_[numbers_per_block * i]);
    take_mixture(task, island);
}

/// Changes the blocks' impulses from those in after_ to those in before_, and the motions with
/// them. Keeps what undo_mixture() needs.
void ContactSolver::take_mixture(const Task& task, Island island)
{
    std::copy(after_.all().begin(), after_.all().end(), good_.all().begin());
    save(task, island);
    for (std::size_t i = 0; i < island.size(); ++i) {
        ContactBlock& block = blocks_[island[i]];
        ContactVector change = contact_vector(block, block.impulse);
        write(block, &before_[numbers_per_block * i]);
        const ContactVector now = contact_vector(block, block.impulse);
        for (std::size_t k = 0; k < change.size(); ++k) change[k] = now[k] - change[k];
        apply(block, change, task.motions);
    }
}

void ContactSolver::undo_mixture(const Task& task, Island island)
{
    restore(task, island);
    for (std::size_t i = 0; i < island.size(); ++i) {
        write(blocks_[island[i]], &good_[numbers_per_block * i]);
    }
}

void ContactSolver::save(const Task& task, Island island)
{
    saved_.resize(task.motions.size());
    for (const std::uint32_t i : island) {
        saved_[blocks_[i].a] = task.motions[blocks_[i].a];
        saved_[blocks_[i].b] = task.motions[blocks_[i].b];
    }
}

void ContactSolver::restore(const Task& task, Island island)
{
    for (const std::uint32_t i : island) {
        task.motions[blocks_[i].a] = saved_[blocks_[i].a];
        task.motions[blocks_[i].b] = saved_[blocks_[i].b];
    }
}

double ContactSolver::solve_block(ContactBlock& block, const Task& task, Effort depth)
{
    ContactVector velocity = velocity_at(block, task.motions[block.a], task.motions[block.b]);
    if (block.turns) {
        for (std::size_t i = 0; i < 5; ++i) velocity[i] += block.centripetal_velocity[i];
    }
    const bool pushes_only = task.mode == Mode::positions;
    const double tolerance = task.limits.tolerance * (pushes_only ? block.size : 1.0);
    if (pushes_only ? normals_are_solved(block, velocity, tolerance)
                    : is_solved(block, velocity, tolerance)) {
        return 0.0;
    }
    if (!block.has_matrix) build_matrix(block, responses_[block.a], responses_[block.b]);
    const ContactVector change = pushes_only ? scene::solve_normals(block, velocity, tolerance)
                                 : depth == Effort::full
                                     ? scene::solve(block, velocity, tolerance)
                                     : scene::iterate(block, velocity, tolerance);
    apply(block, change, task.motions);
    const ContactVector gained = times(block.matrix, change);
    const double arm = block.torsion_arm;
    double most = std::max({std::abs(gained[0]), std::abs(gained[3]), std::abs(gained[4])});
    for (const std::size_t turn : {1U, 2U, 5U}) most = std::max(most, arm * std::abs(gained[turn]));
    return pushes_only ? most / block.size : most;
}

ContactVector ContactSolver::solve_alone(ContactBlock& block, const ContactVector& velocity,
                                         double tolerance)
{
    if (!block.has_matrix) build_matrix(block, responses_[block.a], responses_[block.b]);
    return scene::solve(block, velocity, tolerance);
}

void ContactSolver::apply(const ContactBlock& block, const ContactVector& change,
                          std::span<BodyMotion> motions)
{
    Wrench push = wrench(block, change);
    if (block.b != 0) scene::apply(push, block.arm_b, responses_[block.b], motions[block.b]);
    if (block.a == 0) return;
    push.impulse = -push.impulse;
    push.angular = -push.angular;
    scene::apply(push, block.arm_a, responses_[block.a], motions[block.a]);
}

void ContactSolver::count_contacts()
{
    contacts_.resize(responses_.size());
    for (std::uint32_t& count : contacts_.all()) count = 0;
    for (const ContactBlock& block : blocks_.all()) {
        ++contacts_[block.a];
        ++contacts_[block.b];
    }
}

/// True if no other block shares a body with this block.
bool ContactSolver::is_alone(const ContactBlock& block) const
{
    return (!responds(block.a) || contacts_[block.a] == 1) &&
           (!responds(block.b) || contacts_[block.b] == 1);
}

/// Sorts the blocks by islands: first those of the body with the lowest index, each in the order
/// of its blocks.
void ContactSolver::find_islands()
{
    const std::size_t bodies = responses_.size();
    for (SolverIndex i = 0; i < bodies; ++i) islands_.reset(i);
    for (const ContactBlock& block : blocks_.all()) {
        if (responds(block.a) && responds(block.b)) islands_.join(block.a, block.b);
    }
    starts_.resize(bodies + 1);
    for (std::uint32_t& start : starts_.all()) start = 0;
    const auto root_of_block = [&](const ContactBlock& block) {
        return islands_.root_of(responds(block.a) ? block.a : block.b);
    };
    for (const ContactBlock& block : blocks_.all()) ++starts_[root_of_block(block) + 1];
    for (std::size_t i = 1; i <= bodies; ++i) starts_[i] += starts_[i - 1];
    order_.resize(blocks_.size());
    for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
        order_[starts_[root_of_block(blocks_[i])]++] = i;
    }
    // Now every entry is the end of its island.
    starts_.resize(bodies);
}

} // namespace hapnet::scene

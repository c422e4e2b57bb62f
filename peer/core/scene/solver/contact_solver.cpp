// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/solver/contact_solver.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

/// Sweeps that a scene at rest or nearly so is done with: before that, no book is kept.
constexpr std::uint32_t plain_sweeps = 2;

/// The impulses as seven numbers of one kind, N s.
template <typename Visit>
void for_parts(ContactBlock& block, Visit visit)
{
    for (std::size_t i = 0; i < block.count; ++i) {
        visit(block.impulse.normal[i], block.before.normal[i], block.direction.normal[i], 1.0);
    }
    visit(block.impulse.tangent_1, block.before.tangent_1, block.direction.tangent_1, 1.0);
    visit(block.impulse.tangent_2, block.before.tangent_2, block.direction.tangent_2, 1.0);
    const double arm = block.torsion_arm > 0.0 ? 1.0 / block.torsion_arm : 0.0;
    visit(block.impulse.torsion, block.before.torsion, block.direction.torsion, arm);
}

} // namespace

ContactSolver::ContactSolver(std::size_t bodies, std::size_t blocks)
    : responses_{bodies + 1}, ending_{bodies + 1}, mean_{bodies + 1}, blocks_{blocks}
{}

void ContactSolver::begin(std::size_t bodies)
{
    responses_.resize(bodies + 1);
    ending_.resize(bodies + 1);
    mean_.resize(bodies + 1);
    blocks_.clear();
}

SolverOutcome ContactSolver::solve(const SolverLimits& limits)
{
    return run({Mode::contacts, ending_.all(), limits.quiet}, limits);
}

SolverOutcome ContactSolver::separate(const SolverLimits& limits)
{
    for (ContactBlock& block : blocks_.all()) block.impulse = {};
    return run({Mode::separations, mean_.all(), limits.quiet}, limits);
}

SolverOutcome ContactSolver::run(const Task& task, const SolverLimits& limits)
{
    SolverOutcome outcome;
    double was2 = 0.0;
    while (outcome.sweeps < limits.sweeps_max) {
        const bool keeps_book = outcome.sweeps >= plain_sweeps;
        if (keeps_book) mark();
        const bool forward = outcome.sweeps % 2 == 0 || keeps_book;
        outcome.change = sweep(task, forward);
        ++outcome.sweeps;
        if (outcome.change <= limits.enough) break;
        if (keeps_book && outcome.sweeps < limits.sweeps_max) {
            was2 = go_on(task, was2, outcome.sweeps == plain_sweeps + 1);
        }
    }
    return outcome;
}

double ContactSolver::sweep(const Task& task, bool forward)
{
    double change = 0.0;
    const std::span<ContactBlock> blocks = blocks_.all();
    if (forward) {
        for (ContactBlock& block : blocks) change = std::max(change, visit(block, task));
    } else {
        for (std::size_t i = blocks.size(); i-- > 0;) {
            change = std::max(change, visit(blocks[i], task));
        }
    }
    return change;
}

double ContactSolver::visit(ContactBlock& block, const Task& task)
{
    const Modal velocity = velocity_at(block, task.motions[block.a], task.motions[block.b]);
    const bool pushes_only = task.mode == Mode::separations;
    if (pushes_only ? is_separated(block, velocity, task.quiet)
                    : is_solved(block, velocity, task.quiet)) {
        return 0.0;
    }
    if (!block.has_matrix) build_matrix(block, responses_[block.a], responses_[block.b]);
    const Modal change = pushes_only ? scene::solve_normals(block, velocity, task.quiet)
                                     : scene::solve(block, velocity, task.quiet);
    apply(block, change, task.motions);
    const Modal gained = times(block.matrix, change);
    const double arm = block.torsion_arm;
    double most = std::max({std::abs(gained[0]), std::abs(gained[3]), std::abs(gained[4])});
    for (const std::size_t turn : {1U, 2U, 5U}) most = std::max(most, arm * std::abs(gained[turn]));
    return most;
}

Modal ContactSolver::solve_one(ContactBlock& block, const Modal& velocity, double quiet)
{
    if (!block.has_matrix) build_matrix(block, responses_[block.a], responses_[block.b]);
    return scene::solve(block, velocity, quiet);
}

void ContactSolver::apply(const ContactBlock& block, const Modal& change,
                          std::span<BodyMotion> motions)
{
    Wrench push = wrench(block, change);
    if (block.b != 0) scene::apply(push, block.arm_b, responses_[block.b], motions[block.b]);
    if (block.a == 0) return;
    push.impulse = -push.impulse;
    push.angular = -push.angular;
    scene::apply(push, block.arm_a, responses_[block.a], motions[block.a]);
}

void ContactSolver::mark()
{
    for (ContactBlock& block : blocks_.all()) block.before = block.impulse;
}

/// Goes on along the conjugate direction after a sweep; returns the squared length of what the
/// sweep changed.
double ContactSolver::go_on(const Task& task, double was2, bool is_first)
{
    double now2 = 0.0;
    for (ContactBlock& block : blocks_.all()) {
        for_parts(block, [&](double& now, double& before, double&, double per_arm) {
            const double gone = (now - before) * per_arm;
            now2 += gone * gone;
        });
    }
    const double share = is_first || !(now2 <= was2) ? 0.0 : now2 / was2;
    for (ContactBlock& block : blocks_.all()) {
        const Modal old = modal(block, block.impulse);
        for_parts(block, [&](double& now, double& before, double& direction, double) {
            const double gone = now - before;
            const double further = share > 0.0 ? share * direction : 0.0;
            now += further;
            direction = further + gone;
        });
        if (share == 0.0) continue;
        Modal change = modal(block, block.impulse);
        for (std::size_t i = 0; i < change.size(); ++i) change[i] -= old[i];
        apply(block, change, task.motions);
    }
    return now2;
}

} // namespace hapnet::scene

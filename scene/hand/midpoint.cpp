// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/midpoint.hpp"

#include "proto/base/ensure.hpp"
#include "scene/maths/matrix6.hpp"
#include "scene/maths/root_of_half.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapnet::scene {

namespace {

constexpr double swing_max = 0.25;    // radians of the stiffest mode in a substep
constexpr double rotation_max = 0.05; // radians of the body in a substep

struct Mean {
    double force = 0.0;
    double slope = 0.0; // derivative of the force by the mean closing speed
};

/// The energy of a unilateral spring over its stiffness, and its force. `bend` is the depth beyond
/// which its force no longer grows.
struct Elastic {
    double energy = 0.0;
    double force = 0.0;
};
Elastic elastic(double depth, double bend)
{
    if (depth <= 0.0) return {};
    if (depth <= bend) return {0.5 * depth * depth, depth};
    return {bend * (depth - 0.5 * bend), bend};
}

/// Returns the mean force of a unilateral spring whose depth grows evenly from `depth` at the rate
/// `closing`.
Mean mean_force(const HandSpring& spring, double depth, double closing, double substep)
{
    const double bend = spring.stiffness > 0.0 ? spring.force_max / spring.stiffness
                                               : std::numeric_limits<double>::infinity();
    const double way = substep * closing;
    const double after = depth + way;
    if (depth <= 0.0 && after <= 0.0) return {};
    const Elastic before = elastic(depth, bend);
    const Elastic then = elastic(after, bend);
    const double size = std::max(std::abs(depth), std::abs(after));
    Mean mean;
    if (std::abs(way) <= 1e-6 * size) {
        mean.force = spring.stiffness * 0.5 * (before.force + then.force);
        mean.slope = after < bend ? 0.5 * spring.stiffness * substep : 0.0;
    } else {
        const double gradient = (then.energy - before.energy) / way;
        mean.force = spring.stiffness * gradient;
        mean.slope = spring.stiffness * (then.force - gradient) / way * substep;
    }
    // The damper acts while body and hand overlap.
    const double from = std::max(depth, 0.0);
    const double to = std::max(after, 0.0);
    mean.force += spring.damping * (to - from) / substep;
    if (after > 0.0) mean.slope += spring.damping;
    if (mean.force <= 0.0) return {};
    if (mean.force >= spring.force_max) return {spring.force_max, 0.0};
    return mean;
}

glm::dvec3 any_tangent(const glm::dvec3& normal)
{
    const glm::dvec3 size = glm::abs(normal);
    const bool is_x_least = size.x <= size.y && size.x <= size.z;
    const glm::dvec3 axis = is_x_least         ? glm::dvec3{1.0, 0.0, 0.0}
                            : size.y <= size.z ? glm::dvec3{0.0, 1.0, 0.0}
                                               : glm::dvec3{0.0, 0.0, 1.0};
    return glm::normalize(glm::cross(normal, axis));
}

} // namespace

template <bool rubs>
MidpointRule<rubs>::MidpointRule(MovingBody& body, const BodyDynamics& dynamics,
                                 std::span<const HandSpring> springs, std::span<SpringImpulse> work)
    : body_{body},
      dynamics_{dynamics},
      work_{work},
      rotates_{dynamics.inverse_inertia != glm::dmat3{0.0}},
      inverse_inertia_{dynamics.inverse_inertia},
      inertia_now_{dynamics.inverse_inertia}
{
    base::ensure(springs.size() <= springs_max && springs.size() <= work.size());
    const glm::dmat3 axes = axes_of(body.orientation);
    for (const HandSpring& form : springs) {
        Spring& spring = spring_[springs_++];
        spring.form = &form;
        spring.depth = -form.gap;
        if (form.holds) {
            spring.anchor = form.arm * axes;
            spring.hand = form.arm + form.stretch;
        } else {
            spring.surface = BoxSurface{form, dynamics, axes};
            spring.hand = form.arm + (form.radius + form.gap) * form.normal;
        }
    }
}

template <bool rubs>
void MidpointRule<rubs>::set_friction(std::span<FrictionSpring> frictions) requires rubs
{
    for (std::size_t i = 0; i < springs_; ++i) {
        frictions[i].slid = glm::dvec3{0.0};
        pull_[i].form = &frictions[i];
        pull_[i].stretch = frictions[i].stretch;
    }
}

template <bool rubs>
int MidpointRule<rubs>::substeps(double time)
{
    set_rows(PlaneDrag{dynamics_, time}, time);
    double square = 0.0;
    for (std::size_t i = 0; i < rows_; ++i) {
        const Row& row = row_[i];
        square += 2.0 * spring_[row.spring].form->stiffness * dot(row.response, row.response);
    }
    const glm::dvec3 turning = inertia_now_ * body_.angular_momentum;
    const double swing = time * std::sqrt(square) / swing_max;
    const double turn = time * std::sqrt(glm::dot(turning, turning)) / rotation_max;
    const double most = std::max(swing, turn);
    const int substeps_max = static_cast<int>(MidpointBudget::substeps_max(rows_));
    return most < substeps_max ? std::min(1 + static_cast<int>(most), substeps_max) : substeps_max;
}

template <bool rubs>
std::size_t MidpointRule<rubs>::advance(double time)
{
    const int count = substeps(time);
    const double substep = time / count;
    const PlaneDrag drag{dynamics_, substep};
    for (int i = 0; i < count; ++i) {
        const bool are_set = !rubs && count == 1; // by substeps()
        if (!are_set) set_rows(drag, substep);
        solve(substep);
        apply(drag, substep);
    }
    return rows_solved_;
}

template <bool rubs>
void MidpointRule<rubs>::set_rows(const PlaneDrag& drag, double substep)
{
    const double half = 0.5 * substep;
    const glm::dvec3 velocity = drag.mean_velocity(body_.velocity, dynamics_.acceleration);
    const glm::dvec3 momentum = body_.angular_momentum + half * dynamics_.torque;
    const glm::dvec3 moved = half * body_.velocity;
    const glm::dvec3 angle = half * (inertia_now_ * body_.angular_momentum);
    inverse_inertia_ = inertia_now_;
    if (rotates_ && !dynamics_.rotates_uniformly) {
        const glm::dmat3 turn = axes_of(rotation_by(angle));
        inverse_inertia_ = turn * inertia_now_ * glm::transpose(turn);
    }
    const RootOfHalf root{inverse_inertia_};
    const glm::dmat3 now = axes_of(body_.orientation);
    const glm::dmat3 axes = axes_of(rotation_by(angle) * body_.orientation);
    const glm::dvec3 spin = inverse_inertia_ * momentum;
    rows_ = 0;
    const auto add = [&](std::size_t i, const glm::dvec3& normal, const glm::dvec3& arm,
                         double depth) {
        Row& row = row_[rows_++];
        row = {i, normal, glm::cross(arm, normal), depth};
        row.closing =
            glm::dot(normal, velocity - spring_[i].form->velocity) + glm::dot(row.lever, spin);
        row.response = {drag.root_of_response(normal), root.of(row.lever)};
    };
    for (std::size_t i = 0; i < springs_; ++i) {
        Spring& spring = spring_[i];
        if (spring.form->holds) {
            const glm::dvec3 arm = axes * spring.anchor;
            const glm::dvec3 stretch = spring.hand - now * spring.anchor;
            for (int axis : {0, 1, 2}) {
                glm::dvec3 normal{0.0};
                normal[axis] = 1.0;
                add(i, normal, arm, -stretch[axis]);
            }
            continue;
        }
        const glm::dvec3 hand = spring.hand + half * spring.form->velocity - moved;
        if (spring.depth <= 0.0) spring.depth = spring.surface.at(now, spring.hand).depth;
        const ContactGeometry geometry = spring.surface.at(axes, hand);
        add(i, geometry.normal, hand, spring.depth);
        if constexpr (rubs) {
            if (!is_rough(i)) continue;
            const glm::dvec3& normal = geometry.normal;
            const glm::dvec3 arm = hand - (spring.form->radius - geometry.depth) * normal;
            glm::dvec3& stretch = pull_[i].stretch;
            stretch -= glm::dot(stretch, normal) * normal;
            const glm::dvec3 tangent = any_tangent(normal);
            for (const glm::dvec3& along : {tangent, glm::cross(normal, tangent)})
                add(i, along, arm, -glm::dot(stretch, along));
        }
    }
}

template <bool rubs>
typename MidpointRule<rubs>::Six MidpointRule<rubs>::update_forces(const Six& velocities,
                                                                   double substep)
{
    Six missed = velocities;
    for (std::size_t i = 0; i < rows_; ++i) {
        Row& row = row_[i];
        const HandSpring& spring = *spring_[row.spring].form;
        row.mean = row.closing - substep * dot(row.response, velocities);
        if (spring.holds) {
            row.slope = 0.5 * spring.stiffness * substep + spring.damping;
            row.force = spring.stiffness * row.depth + row.slope * row.mean;
            if (i + 1 == rows_ || row_[i + 1].spring != row.spring) limit_grip_force(i - 2);
        } else {
            const Mean mean = mean_force(spring, row.depth, row.mean, substep);
            row.force = mean.force;
            row.slope = mean.slope;
            if constexpr (rubs) {
                if (!is_rough(row.spring)) continue;
                for (std::size_t along : {i + 1, i + 2})
                    row_[along].mean =
                        row_[along].closing - substep * dot(row_[along].response, velocities);
                update_pull(i, substep);
                i += 2;
            }
        }
    }
    for (std::size_t i = 0; i < rows_; ++i) missed.add(-row_[i].force, row_[i].response);
    return missed;
}

/// Limits the three rows of a spring that holds to its greatest force together.
template <bool rubs>
void MidpointRule<rubs>::limit_grip_force(std::size_t first)
{
    Row* const rows = &row_[first];
    Spring& spring = spring_[rows[0].spring];
    const glm::dvec3 force{rows[0].force, rows[1].force, rows[2].force};
    const double square = glm::dot(force, force);
    const double most = spring.form->force_max;
    spring.is_limited = square > most * most;
    if (!spring.is_limited) return;
    const double size = std::sqrt(square);
    spring.pull = force / size;
    for (std::size_t i = 0; i < 3; ++i) {
        rows[i].force *= most / size;
        rows[i].slope *= most / size;
    }
}

template <bool rubs>
bool MidpointRule<rubs>::is_rough(std::size_t spring) const
{
    if constexpr (!rubs)
        return false;
    else
        return !spring_[spring].form->holds && pull_[spring].form->limits.is_rough();
}

/// Updates the pull along the surface, cut to the cone of the push.
template <bool rubs>
void MidpointRule<rubs>::update_pull(std::size_t push, double substep) requires rubs
{
    Row& first = row_[push + 1];
    Row& second = row_[push + 2];
    const HandSpring& spring = *spring_[first.spring].form;
    Pull& pull = pull_[first.spring];
    for (Row* const row : {&first, &second}) {
        row->slope = 0.5 * spring.stiffness * substep + spring.damping;
        row->force = spring.stiffness * row->depth + row->slope * row->mean;
    }
    const double square = first.force * first.force + second.force * second.force;
    const double most = pull.form->limit() * row_[push].force;
    pull.is_cut = square > most * most;
    if (!pull.is_cut) return;
    const double size = std::sqrt(square);
    pull.along_1 = first.force / size;
    pull.along_2 = second.force / size;
    for (Row* const row : {&first, &second}) {
        row->force *= most / size;
        row->slope *= most / size;
    }
}

/// Moves the proxy at the end of a substep, if it slides.
template <bool rubs>
void MidpointRule<rubs>::slide(std::size_t push, double substep) requires rubs
{
    const Row& first = row_[push + 1];
    const Row& second = row_[push + 2];
    Pull& pull = pull_[first.spring];
    const glm::dvec3 wanted = -(first.depth + substep * first.mean) * first.normal -
                              (second.depth + substep * second.mean) * second.normal;
    pull.stretch = wanted;
    if (pull.is_cut) {
        const double most = pull.form->limit() * row_[push].force;
        const double pulls = spring_[first.spring].form->stiffness * length(wanted);
        if (pulls > most || pulls == 0.0) pull.stretch *= pulls > 0.0 ? most / pulls : 0.0;
        pull.form->slid += wanted - pull.stretch;
    }
    pull.form->slides = pull.is_cut;
}

/// Makes one of Newton's steps, with each force linear along its slope. In the scaled velocities
/// the matrix is 1 + a symmetric matrix, so Cholesky's method solves it.
template <bool rubs>
typename MidpointRule<rubs>::Six MidpointRule<rubs>::newton_step(const Six& missed,
                                                                 double substep) const
{
    if constexpr (rubs) return newton_step_unsymmetric(missed, substep);
    std::array<std::array<double, 6>, 6> lower{};
    for (std::size_t i = 0; i < 6; ++i) lower[i][i] = 1.0;
    const auto add = [&](const Six& direction, double scale) {
        const std::array<double, 6> d{direction.linear.x,  direction.linear.y,
                                      direction.linear.z,  direction.angular.x,
                                      direction.angular.y, direction.angular.z};
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t j = 0; j <= i; ++j) lower[i][j] += scale * d[i] * d[j];
        }
    };
    for (std::size_t i = 0; i < rows_; ++i) {
        const Row& row = row_[i];
        if (row.slope > 0.0) add(row.response, substep * row.slope);
        const Spring& spring = spring_[row.spring];
        const bool is_last = i + 1 == rows_ || row_[i + 1].spring != row.spring;
        if (!spring.form->holds || !is_last || !spring.is_limited) continue;
        // A pull at its greatest force only turns: it has no slope along its own direction.
        Six pull;
        for (int axis : {0, 1, 2})
            pull.add(spring.pull[axis], row_[i - 2 + static_cast<std::size_t>(axis)].response);
        add(pull, -substep * row.slope);
    }
    std::array<double, 6> x{-missed.linear.x,  -missed.linear.y,  -missed.linear.z,
                            -missed.angular.x, -missed.angular.y, -missed.angular.z};
    for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = lower[i][j];
            for (std::size_t k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
            // No eigenvalue is below 1; a smaller one is rounding.
            lower[i][j] = i == j ? std::sqrt(std::max(sum, 1.0)) : sum / lower[j][j];
        }
        for (std::size_t k = 0; k < i; ++k) x[i] -= lower[i][k] * x[k];
        x[i] /= lower[i][i];
    }
    for (std::size_t i = 6; i-- > 0;) {
        for (std::size_t k = i + 1; k < 6; ++k) x[i] -= lower[k][i] * x[k];
        x[i] /= lower[i][i];
    }
    return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
}

/// As newton_step(), where a cut pull follows its push: then the matrix is not symmetric.
template <bool rubs>
typename MidpointRule<rubs>::Six
MidpointRule<rubs>::newton_step_unsymmetric(const Six& missed, double substep) const requires rubs
{
    Matrix6 matrix;
    const auto add = [&](const Six& to, const Six& from, double scale) {
        matrix.add(to.all(), from.all(), substep * scale);
    };
    for (std::size_t i = 0; i < rows_; ++i) {
        const Row& row = row_[i];
        add(row.response, row.response, row.slope);
        const Spring& spring = spring_[row.spring];
        const bool is_last = i + 1 == rows_ || row_[i + 1].spring != row.spring;
        if (!is_last) continue;
        Six pull;
        if (spring.form->holds) {
            if (!spring.is_limited) continue;
            for (int axis : {0, 1, 2})
                pull.add(spring.pull[axis], row_[i - 2 + static_cast<std::size_t>(axis)].response);
            add(pull, pull, -row.slope);
        } else if (is_rough(row.spring) && pull_[row.spring].is_cut) {
            const Pull& cut = pull_[row.spring];
            pull.add(cut.along_1, row_[i - 1].response);
            pull.add(cut.along_2, row.response);
            add(pull, pull, -row.slope);
            const Row& push = row_[i - 2];
            add(pull, push.response, cut.form->limit() * push.slope);
        }
    }
    std::array<double, 6> x = missed.all();
    for (double& each : x) each = -each;
    matrix.solve(x);
    return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}};
}

/// Finds the velocities that follow from the springs' forces at these velocities. They are the
/// minimum of a convex function, since no force falls with its depth. Where a step goes beyond the
/// minimum along its line, the excess is taken back.
template <bool rubs>
void MidpointRule<rubs>::solve(double substep)
{
    constexpr double converged = 1e-13;
    constexpr double overshot = 0.5;
    double easiest = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < rows_; ++i) {
        easiest = std::max(easiest, dot(row_[i].response, row_[i].response));
        size = std::max(size, std::abs(row_[i].closing));
    }
    const double negligible = converged * size / substep; // for the scaled velocities
    const auto is_negligible = [&](const Six& six) {
        return dot(six, six) * easiest <= negligible * negligible;
    };
    Six velocities;
    Six missed = update_forces(velocities, substep);
    for (std::size_t step = 1; step < MidpointBudget::newton_steps_max; ++step) {
        // A step is no longer than the error.
        if (is_negligible(missed)) return;
        const Six change = newton_step(missed, substep);
        rows_solved_ += rows_;
        const double falls = dot(missed, change);
        velocities.add(1.0, change);
        missed = update_forces(velocities, substep);
        if (is_negligible(change)) return;
        const double rises = dot(missed, change);
        if (!(rises > -overshot * falls) || step + 1 == MidpointBudget::newton_steps_max) continue;
        velocities.add(-rises / (rises - falls), change);
        missed = update_forces(velocities, substep);
        ++step;
    }
}

template <bool rubs>
void MidpointRule<rubs>::apply(const PlaneDrag& drag, double substep)
{
    glm::dvec3 force{0.0};
    glm::dvec3 torque = dynamics_.torque;
    Six velocities;
    for (std::size_t i = 0; i < rows_; ++i) {
        const Row& row = row_[i];
        force -= row.force * row.normal;
        torque -= row.force * row.lever;
        velocities.add(row.force, row.response);
        work_[row.spring].impulse -= (substep * row.force) * row.normal;
    }
    const glm::dvec3 acceleration = dynamics_.acceleration + dynamics_.inverse_mass * force;
    const glm::dvec3 moved = substep * drag.mean_velocity(body_.velocity, acceleration);
    body_.position += moved;
    body_.velocity = drag.velocity_after(body_.velocity, acceleration);
    if (rotates_) {
        const glm::dvec3 mean = body_.angular_momentum + (0.5 * substep) * torque;
        const glm::dvec3 angle = substep * (inverse_inertia_ * mean);
        body_.angular_momentum += substep * torque;
        body_.orientation = rotated(body_.orientation, angle);
        if (!dynamics_.rotates_uniformly) {
            const glm::dmat3 turn = axes_of(rotation_by(angle));
            inertia_now_ = turn * inertia_now_ * glm::transpose(turn);
        }
    }
    for (std::size_t i = 0; i < rows_; ++i) {
        const Row& row = row_[i];
        Spring& spring = spring_[row.spring];
        if (spring.form->holds) continue;
        const double closing = row.closing - substep * dot(row.response, velocities);
        spring.depth = row.depth + substep * closing;
        if constexpr (rubs) {
            if (!is_rough(row.spring)) continue;
            for (std::size_t along : {i + 1, i + 2})
                row_[along].mean =
                    row_[along].closing - substep * dot(row_[along].response, velocities);
            slide(i, substep);
            i += 2;
        }
    }
    for (std::size_t i = 0; i < springs_; ++i)
        spring_[i].hand += substep * spring_[i].form->velocity - moved;
}

template class MidpointRule<false>;
template class MidpointRule<true>;

} // namespace hapnet::scene

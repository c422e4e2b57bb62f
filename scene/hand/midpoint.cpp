// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/midpoint.hpp"

#include "proto/base/ensure.hpp"
#include "scene/maths/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

constexpr int substeps_max = 64;
constexpr double swing_max = 0.25;    // radians of the stiffest mode in a sub-tick
constexpr double rotation_max = 0.05; // radians of the body in a sub-tick

struct Mean {
    double force = 0.0;
    double slope = 0.0; // over the mean closing speed
};

/// The energy of a unilateral spring over its stiffness and its force, with `bend` the depth from
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

/// The mean force of a unilateral spring whose depth grows evenly from `depth` at `closing`.
Mean mean_force(const HandSpring& spring, double depth, double closing, double substep)
{
    const double bend = spring.force_max / spring.stiffness;
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
    // The damper acts while they overlap.
    const double from = std::max(depth, 0.0);
    const double to = std::max(after, 0.0);
    mean.force += spring.damping * (to - from) / substep;
    if (after > 0.0) mean.slope += spring.damping;
    if (mean.force <= 0.0) return {};
    if (mean.force >= spring.force_max) return {spring.force_max, 0.0};
    return mean;
}

} // namespace

MidpointRule::MidpointRule(MovingBody& body, const BodyDynamics& dynamics,
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
            spring.surface = BoxSurface{form, dynamics.half, axes};
            spring.hand = form.arm + (form.radius + form.gap) * form.normal;
        }
    }
}

int MidpointRule::substeps(double time)
{
    set_rows(time);
    double square = 0.0;
    for (std::size_t i = 0; i < rows_; ++i) {
        const Row& row = row_[i];
        square += spring_[row.spring].form->stiffness *
                  (glm::dot(row.normal, dynamics_.inverse_mass * row.normal) +
                   glm::dot(row.lever, row.inverse_inertia_lever));
    }
    const glm::dvec3 turning = inertia_now_ * body_.angular_momentum;
    const double swing = time * std::sqrt(square) / swing_max;
    const double turn = time * std::sqrt(glm::dot(turning, turning)) / rotation_max;
    const double most = std::max(swing, turn);
    return most < substeps_max ? 1 + static_cast<int>(most) : substeps_max;
}

void MidpointRule::advance(double time)
{
    const int count = substeps(time);
    const double substep = time / count;
    for (int i = 0; i < count; ++i) {
        set_rows(substep);
        solve(substep);
        apply(substep);
    }
}

void MidpointRule::set_rows(double substep)
{
    const double half = 0.5 * substep;
    const glm::dvec3 moved = half * body_.velocity;
    const glm::dvec3 angle = half * (inertia_now_ * body_.angular_momentum);
    inverse_inertia_ = inertia_now_;
    if (rotates_ && !dynamics_.rotates_uniformly) {
        const glm::dmat3 turn = axes_of(rotation_by(angle));
        inverse_inertia_ = turn * inertia_now_ * glm::transpose(turn);
    }
    const glm::dmat3 now = axes_of(body_.orientation);
    const glm::dmat3 axes = axes_of(rotation_by(angle) * body_.orientation);
    rows_ = 0;
    const auto add = [&](std::size_t i, const glm::dvec3& normal, const glm::dvec3& arm,
                         double depth) {
        Row& row = row_[rows_++];
        row = {i, normal, glm::cross(arm, normal)};
        row.inverse_inertia_lever = inverse_inertia_ * row.lever;
        row.depth = depth;
        row.closing =
            glm::dot(normal,
                     body_.velocity - spring_[i].form->velocity + half * dynamics_.acceleration) +
            glm::dot(row.inverse_inertia_lever, body_.angular_momentum + half * dynamics_.torque);
        row.mean = row.closing;
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
    }
    for (std::size_t i = 0; i < rows_; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            coupling_[i][j] = coupling_[j][i] =
                glm::dot(row_[i].normal, dynamics_.inverse_mass * row_[j].normal) +
                glm::dot(row_[i].lever, row_[j].inverse_inertia_lever);
        }
    }
}

void MidpointRule::update_forces(double substep)
{
    for (std::size_t i = 0; i < rows_; ++i) {
        Row& row = row_[i];
        const HandSpring& spring = *spring_[row.spring].form;
        if (spring.holds) {
            row.slope = 0.5 * spring.stiffness * substep + spring.damping;
            row.force = spring.stiffness * row.depth + row.slope * row.mean;
            if (i + 1 == rows_ || row_[i + 1].spring != row.spring) limit_grip_force(i - 2);
        } else {
            const Mean mean = mean_force(spring, row.depth, row.mean, substep);
            row.force = mean.force;
            row.slope = mean.slope;
        }
    }
}

/// The three rows of a spring that holds pull no more together than it can.
void MidpointRule::limit_grip_force(std::size_t first)
{
    Row* const rows = &row_[first];
    const double square = rows[0].force * rows[0].force + rows[1].force * rows[1].force +
                          rows[2].force * rows[2].force;
    const double most = spring_[rows[0].spring].form->force_max;
    if (square <= most * most) return;
    const double share = most / std::sqrt(square);
    for (std::size_t i = 0; i < 3; ++i) {
        rows[i].force *= share;
        rows[i].slope = 0.0;
    }
}

/// One of Newton's steps for the mean closing speeds: each force is taken to follow its slope.
void MidpointRule::newton_step(double substep)
{
    // In x = sqrt(slope) * change of closing, the matrix is 1 + symmetric: Cholesky.
    // The first rows_ are written before they are read.
    // NOLINTBEGIN(cppcoreguidelines-pro-type-member-init)
    std::array<std::array<double, rows_max>, rows_max> lower;
    std::array<double, rows_max> root;
    std::array<double, rows_max> x;
    // NOLINTEND(cppcoreguidelines-pro-type-member-init)
    const double half = 0.5 * substep;
    for (std::size_t i = 0; i < rows_; ++i) {
        root[i] = std::sqrt(std::max(row_[i].slope, 0.0));
        double reached = row_[i].closing;
        for (std::size_t j = 0; j < rows_; ++j) reached -= half * coupling_[i][j] * row_[j].force;
        x[i] = root[i] * (reached - row_[i].mean);
    }
    std::array<double, rows_max> residual{};
    for (std::size_t i = 0; i < rows_; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = half * root[i] * coupling_[i][j] * root[j] + (i == j ? 1.0 : 0.0);
            for (std::size_t k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
            lower[i][j] = i == j ? std::sqrt(sum) : sum / lower[j][j];
        }
        for (std::size_t k = 0; k < i; ++k) x[i] -= lower[i][k] * x[k];
        x[i] /= lower[i][i];
    }
    for (std::size_t i = rows_; i-- > 0;) {
        for (std::size_t k = i + 1; k < rows_; ++k) x[i] -= lower[k][i] * x[k];
        x[i] /= lower[i][i];
        residual[i] = root[i] * x[i]; // by how much the force changes
    }
    for (std::size_t i = 0; i < rows_; ++i) {
        double mean = row_[i].closing;
        for (std::size_t j = 0; j < rows_; ++j)
            mean -= half * coupling_[i][j] * (row_[j].force + residual[j]);
        row_[i].mean = mean;
    }
}

void MidpointRule::solve(double substep)
{
    constexpr int steps_max = 12;
    constexpr double enough = 1e-13;
    for (int step = 0; step < steps_max; ++step) {
        update_forces(substep);
        double before = 0.0;
        std::array<double, rows_max> mean{};
        for (std::size_t i = 0; i < rows_; ++i) mean[i] = row_[i].mean;
        newton_step(substep);
        double change = 0.0;
        for (std::size_t i = 0; i < rows_; ++i) {
            change = std::max(change, std::abs(row_[i].mean - mean[i]));
            before = std::max(before, std::abs(row_[i].closing) + std::abs(mean[i]));
        }
        if (change <= enough * before) break;
    }
    update_forces(substep);
}

void MidpointRule::apply(double substep)
{
    glm::dvec3 force{0.0};
    glm::dvec3 torque = dynamics_.torque;
    for (std::size_t i = 0; i < rows_; ++i) {
        const Row& row = row_[i];
        force -= row.force * row.normal;
        torque -= row.force * row.lever;
        work_[row.spring].impulse -= (substep * row.force) * row.normal;
    }
    const glm::dvec3 gained = substep * (dynamics_.acceleration + dynamics_.inverse_mass * force);
    const glm::dvec3 moved = substep * (body_.velocity + 0.5 * gained);
    body_.position += moved;
    body_.velocity += gained;
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
        Spring& spring = spring_[row_[i].spring];
        if (!spring.form->holds) {
            double reached = row_[i].closing;
            for (std::size_t j = 0; j < rows_; ++j)
                reached -= 0.5 * substep * coupling_[i][j] * row_[j].force;
            spring.depth = row_[i].depth + substep * reached;
        }
    }
    for (std::size_t i = 0; i < springs_; ++i)
        spring_[i].hand += substep * spring_[i].form->velocity - moved;
}

} // namespace hapnet::scene

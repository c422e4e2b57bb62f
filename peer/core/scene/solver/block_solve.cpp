// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/solver/block.hpp"
#include "peer/core/scene/solver/plane_fit.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

using Friction = std::array<double, 3>; // along the tangents, and torsion over its arm

Modal plus(Modal a, const Modal& b)
{
    for (std::size_t i = 0; i < 6; ++i) a[i] += b[i];
    return a;
}

Modal minus(Modal a, const Modal& b)
{
    for (std::size_t i = 0; i < 6; ++i) a[i] -= b[i];
    return a;
}

/// The unknowns for which the first `rows` modal velocities are `wanted`.
template <std::size_t rows>
std::array<double, rows> weld(const Square<6>& matrix, const std::array<double, rows>& wanted)
{
    Square<rows> part;
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j <= i; ++j) part[i][j] = matrix[i][j];
    }
    return Ldl<rows>{part}.solve(wanted);
}

/// The unknowns (`points` normal impulses, then friction) for which the points have their least
/// speeds and the anchor, when there is friction among them, does not slip.
template <std::size_t points, std::size_t frictions>
std::array<double, points + frictions> hold(const ContactBlock& block, const PointSet& set,
                                            const Modal& velocity)
{
    constexpr std::size_t rows = points + frictions;
    std::array<Modal, rows> row{};
    std::array<double, rows> wanted{};
    for (std::size_t i = 0; i < points; ++i) {
        row[i] = {1.0, block.along_2[set.at[i]], -block.along_1[set.at[i]], 0.0, 0.0, 0.0};
        wanted[i] = block.least[set.at[i]] - block.normal_speed(velocity, set.at[i]);
    }
    for (std::size_t i = 0; i < frictions; ++i) {
        row[points + i][3 + i] = 1.0;
        wanted[points + i] = -velocity[3 + i];
    }
    Square<rows> part;
    for (std::size_t i = 0; i < rows; ++i) {
        const Modal answer = times(block.matrix, row[i]);
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = 0.0;
            for (std::size_t k = 0; k < 6; ++k) sum += answer[k] * row[j][k];
            part[i][j] = sum;
        }
    }
    return Ldl<rows>{part}.solve(wanted);
}

/// One contact with the velocities that it would have without its own impulses.
class Trial {
public:
    Trial(const ContactBlock& block, const Modal& velocity)
        : block_{block},
          free_{minus(velocity, times(block.matrix, modal(block, block.impulse)))},
          answer_{block.impulse}
    {}

    [[nodiscard]] const ContactImpulse& answer() const { return answer_; }
    [[nodiscard]] Modal velocity() const
    {
        return plus(free_, times(block_.matrix, modal(block_, answer_)));
    }

    /// Sticking contact. False when something would pull or friction would pass its limit.
    bool stick(double quiet);
    /// Slipping or frictionless contact: the normal impulses for the friction as it is.
    void push(double quiet);
    /// Slipping contact.
    void slip(double quiet);

private:
    [[nodiscard]] PointSet pushing(double quiet) const;
    [[nodiscard]] PointSet without_pulling(const PointSet& set) const;
    void separate() { answer_ = {}; }
    template <bool sticks>
    void hold_points(PointSet set);
    template <std::size_t points, bool sticks>
    void hold_few(const PointSet& set);
    template <std::size_t points, std::size_t frictions>
    void hold_exactly(const PointSet& set);
    [[nodiscard]] Modal from_friction() const
    {
        return {0.0, 0.0, 0.0, answer_.tangent_1, answer_.tangent_2, answer_.torsion};
    }
    [[nodiscard]] Friction scaled_friction() const
    {
        return {answer_.tangent_1, answer_.tangent_2,
                block_.torsion_arm > 0.0 ? answer_.torsion / block_.torsion_arm : 0.0};
    }
    [[nodiscard]] double normal_sum() const
    {
        return answer_.normal[0] + answer_.normal[1] + answer_.normal[2] + answer_.normal[3];
    }
    [[nodiscard]] double slip_answer() const;
    double slip_once(double step);

    const ContactBlock& block_;
    Modal free_;
    ContactImpulse answer_;
};

PointSet Trial::pushing(double quiet) const
{
    const Modal now = velocity();
    PointSet set;
    for (std::uint32_t i = 0; i < block_.count; ++i) {
        const double speed = block_.normal_speed(now, i) - block_.least[i];
        if (answer_.normal[i] > 0.0 || speed < -quiet) set.add(i);
    }
    return set;
}

PointSet Trial::without_pulling(const PointSet& set) const
{
    PointSet rest;
    for (std::uint32_t i = 0; i < set.count; ++i) {
        if (answer_.normal[set.at[i]] > 0.0) rest.add(set.at[i]);
    }
    return rest;
}

template <std::size_t points, std::size_t frictions>
void Trial::hold_exactly(const PointSet& set)
{
    const Modal given = frictions > 0 ? free_ : plus(free_, times(block_.matrix, from_friction()));
    const auto unknown = hold<points, frictions>(block_, set, given);
    answer_.normal = {};
    for (std::size_t i = 0; i < points; ++i) answer_.normal[set.at[i]] = unknown[i];
    if constexpr (frictions > 0) {
        answer_.tangent_1 = unknown[points];
        answer_.tangent_2 = unknown[points + 1];
        if constexpr (frictions > 2) {
            answer_.torsion = unknown[points + 2];
        } else {
            answer_.torsion = 0.0;
        }
    }
}

template <std::size_t points, bool sticks>
void Trial::hold_few(const PointSet& set)
{
    if constexpr (!sticks) {
        hold_exactly<points, 0>(set);
    } else if (points == 1 || block_.torsion_arm == 0.0) {
        hold_exactly<points, 2>(set);
    } else {
        hold_exactly<points, 3>(set);
    }
}

template <bool sticks>
void Trial::hold_points(PointSet set)
{
    if (set.count == 0) return separate();
    if (set.count == 1) return hold_few<1, sticks>(set);
    if (set.count == 2) return hold_few<2, sticks>(set);
    const PlaneFit fit{block_, set};
    if (fit.is_flat()) {
        // On a line the outermost two say everything.
        const auto& along = fit.is_along_1() ? block_.along_1 : block_.along_2;
        std::uint8_t low = set.at[0];
        std::uint8_t high = set.at[0];
        for (std::uint32_t i = 1; i < set.count; ++i) {
            if (along[set.at[i]] < along[low]) low = set.at[i];
            if (along[set.at[i]] > along[high]) high = set.at[i];
        }
        set.at = {low, high};
        set.count = 2;
        return hold_few<2, sticks>(set);
    }
    const std::array<double, 3> least = fit.modal_least();
    answer_.normal = {};
    if constexpr (sticks) {
        const auto unknown =
            weld<6>(block_.matrix, {least[0] - free_[0], least[1] - free_[1], least[2] - free_[2],
                                    -free_[3], -free_[4], -free_[5]});
        fit.spread({unknown[0], unknown[1], unknown[2]}, answer_.normal);
        answer_.tangent_1 = unknown[3];
        answer_.tangent_2 = unknown[4];
        answer_.torsion = unknown[5];
    } else {
        const Modal given = plus(free_, times(block_.matrix, from_friction()));
        const auto unknown =
            weld<3>(block_.matrix, {least[0] - given[0], least[1] - given[1], least[2] - given[2]});
        fit.spread(unknown, answer_.normal);
    }
}

bool Trial::stick(double quiet)
{
    PointSet set = pushing(quiet);
    for (std::uint32_t round = 0; round < manifold_points_max; ++round) {
        hold_points<true>(set);
        if (set.count == 0) return true;
        const PointSet rest = without_pulling(set);
        if (rest.count == set.count) break;
        set = rest;
    }
    const Friction f = scaled_friction();
    const double limit = block_.friction * normal_sum();
    if (f[0] * f[0] + f[1] * f[1] + f[2] * f[2] > limit * limit) return false;
    const Modal now = velocity();
    for (std::uint32_t i = 0; i < block_.count; ++i) {
        if (block_.normal_speed(now, i) - block_.least[i] < -quiet) return false;
    }
    return true;
}

void Trial::push(double quiet)
{
    PointSet set = pushing(quiet);
    for (std::uint32_t round = 0; round < 2 * manifold_points_max; ++round) {
        hold_points<false>(set);
        if (set.count == 0) return;
        const PointSet rest = without_pulling(set);
        if (rest.count < set.count) {
            set = rest;
            continue;
        }
        const PointSet more = pushing(quiet);
        if (more.count == set.count) return;
        set = more;
    }
    for (double& impulse : answer_.normal) impulse = std::max(impulse, 0.0);
}

/// The largest answer of the slip to friction: no step of one over it overshoots.
double Trial::slip_answer() const
{
    const double arm = block_.torsion_arm;
    const auto& m = block_.matrix;
    const double coupled_1 = std::abs(m[5][3]) * arm;
    const double coupled_2 = std::abs(m[5][4]) * arm;
    const double across = std::abs(m[4][3]);
    return std::max({m[3][3] + across + coupled_1, m[4][4] + across + coupled_2,
                     m[5][5] * arm * arm + coupled_1 + coupled_2});
}

/// Moves friction toward the direction against the slip; returns by how much.
double Trial::slip_once(double step)
{
    const Modal now = velocity();
    const double arm = block_.torsion_arm;
    const Friction was = scaled_friction();
    Friction f{was[0] - step * now[3], was[1] - step * now[4], was[2] - step * now[5] * arm};
    const double limit = block_.friction * normal_sum();
    const double size = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    if (size > limit) {
        for (double& part : f) part *= limit / size;
    }
    answer_.tangent_1 = f[0];
    answer_.tangent_2 = f[1];
    answer_.torsion = f[2] * arm;
    return std::max({std::abs(f[0] - was[0]), std::abs(f[1] - was[1]), std::abs(f[2] - was[2])});
}

void Trial::slip(double quiet)
{
    const double most = slip_answer();
    const double step = most > 0.0 ? 1.0 / most : 0.0;
    constexpr int rounds_max = 8;
    constexpr double settled = 1e-14; // of the impulses: rounding
    push(quiet);
    for (int round = 0; round < rounds_max; ++round) {
        const double change = slip_once(step);
        push(quiet);
        if (change <= settled * normal_sum()) return;
    }
    slip_once(0.0);
}

/// What of such speeds may be rounding, m/s.
double rounding_of(const ContactBlock& block, const Modal& velocity)
{
    constexpr double share = 1e-13;
    return share * (std::abs(velocity[0]) + std::abs(velocity[3]) + std::abs(velocity[4]) +
                    block.torsion_arm *
                        (std::abs(velocity[1]) + std::abs(velocity[2]) + std::abs(velocity[5])));
}

Modal finish(ContactBlock& block, const ContactImpulse& answer)
{
    const Modal change = minus(modal(block, answer), modal(block, block.impulse));
    block.impulse = answer;
    return change;
}

} // namespace

bool is_separated(const ContactBlock& block, const Modal& velocity, double quiet)
{
    for (std::size_t i = 0; i < block.count; ++i) {
        const double excess = block.normal_speed(velocity, i) - block.least[i];
        if (excess < -quiet || (excess > quiet && block.impulse.normal[i] > 0.0)) return false;
        if (block.impulse.normal[i] < 0.0) return false;
    }
    return true;
}

bool is_solved(const ContactBlock& block, const Modal& velocity, double quiet)
{
    if (!is_separated(block, velocity, quiet)) return false;
    if (block.friction == 0.0) return true;
    const double arm = block.torsion_arm;
    const double limit = block.friction * block.normal_sum();
    const Friction slip{velocity[3], velocity[4], velocity[5] * arm};
    const Friction held{block.impulse.tangent_1, block.impulse.tangent_2,
                        arm > 0.0 ? block.impulse.torsion / arm : 0.0};
    const double speed2 = slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2];
    const double held2 = held[0] * held[0] + held[1] * held[1] + held[2] * held[2];
    constexpr double rounding = 1e-12;
    if (held2 > limit * limit * (1.0 + rounding)) return false;
    if (speed2 <= quiet * quiet) return true;
    const double speed = std::sqrt(speed2);
    double miss2 = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double miss = held[i] * speed + limit * slip[i];
        miss2 += miss * miss;
    }
    return miss2 <= rounding * rounding * limit * limit * speed2;
}

Modal solve(ContactBlock& block, const Modal& velocity, double quiet)
{
    if (block.friction == 0.0) return solve_normals(block, velocity, quiet);
    const double still = std::max(quiet, rounding_of(block, velocity));
    Trial trial{block, velocity};
    if (trial.stick(still)) return finish(block, trial.answer());
    Trial slipping{block, velocity};
    slipping.slip(still);
    return finish(block, slipping.answer());
}

Modal solve_normals(ContactBlock& block, const Modal& velocity, double quiet)
{
    Trial trial{block, velocity};
    trial.push(std::max(quiet, rounding_of(block, velocity)));
    return finish(block, trial.answer());
}

} // namespace hapnet::scene

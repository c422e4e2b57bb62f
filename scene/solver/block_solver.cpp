// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/block_solver.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

Ldl<5> factors_of(const ContactBlock& block, const PointSet& set)
{
    const auto& m = block.matrix;
    Square<5> part{};
    for (std::size_t i = 0; i < set.count; ++i) {
        const double u = block.along_1[set.at[i]];
        const double v = block.along_2[set.at[i]];
        ContactVector answer;
        for (std::size_t k = 0; k < 6; ++k) answer[k] = m[k][0] + v * m[k][1] - u * m[k][2];
        for (std::size_t j = 0; j <= i; ++j) part[i][j] = block.normal_speed(answer, set.at[j]);
        for (std::size_t k = 0; k < 3; ++k) part[set.count + k][i] = answer[3 + k];
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j <= i; ++j) part[set.count + i][set.count + j] = m[3 + i][3 + j];
    }
    return Ldl<5>{part};
}

/// True if the last set of that size was a different one. Notes the new set.
bool is_new(BlockFactors& factors, const PointSet& set)
{
    std::uint32_t& known = factors.sets[set.count - 1];
    const bool is_new = known != set.bits;
    known = set.bits;
    return is_new;
}

// The factors that are needed to solve a block. They are found once and stored in it. They need its
// matrix.

/// Returns the factors for one or two points' normal speeds and friction: from impulses to
/// velocities.
const Ldl<5>& few_factors(ContactBlock& block, const PointSet& set)
{
    Ldl<5>& few = block.factors.few[set.count - 1];
    if (is_new(block.factors, set)) few = factors_of(block, set);
    return few;
}

/// Returns the factors of the whole matrix.
const Ldl<6>& whole_factors(ContactBlock& block)
{
    BlockFactors& factors = block.factors;
    if (!factors.has_whole) factors.whole = Ldl<6>{block.matrix};
    factors.has_whole = true;
    return factors.whole;
}

/// Returns the plane through three or four points.
const PlaneFit& fit_of(ContactBlock& block, const PointSet& set)
{
    PlaneFit& fit = block.factors.fits[set.count - 3];
    if (is_new(block.factors, set)) fit = PlaneFit{block.along_1, block.along_2, set};
    return fit;
}

/// Returns the two outermost of points on a line. They determine the others.
PointSet outermost(const ContactBlock& block, const PlaneFit& fit)
{
    const auto& along = fit.is_along_1() ? block.along_1 : block.along_2;
    const PointSet& set = fit.set();
    std::uint32_t low = set.at[0];
    std::uint32_t high = set.at[0];
    for (std::uint32_t i = 1; i < set.count; ++i) {
        if (along[set.at[i]] < along[low]) low = set.at[i];
        if (along[set.at[i]] > along[high]) high = set.at[i];
    }
    PointSet two;
    two.add(std::min(low, high));
    two.add(std::max(low, high));
    return two;
}

/// Returns the largest response of the slip to friction.
double slip_response(const ContactBlock& block)
{
    const double arm = block.torsion_arm;
    const auto& m = block.matrix;
    const double coupled_1 = std::abs(m[5][3]) * arm;
    const double coupled_2 = std::abs(m[5][4]) * arm;
    const double across = std::abs(m[4][3]);
    return std::max({m[3][3] + across + coupled_1, m[4][4] + across + coupled_2,
                     m[5][5] * arm * arm + coupled_1 + coupled_2});
}

/// Returns a step of friction per slip that does not overshoot.
double slip_step(ContactBlock& block)
{
    double& step = block.factors.slip_step;
    if (step > 0.0) return step;
    const double most = slip_response(block);
    step = most > 0.0 ? 1.0 / most : 0.0;
    return step;
}

using Friction = std::array<double, 3>; // along the tangents, and torsion over its arm

ContactVector minus(ContactVector a, const ContactVector& b)
{
    for (std::size_t i = 0; i < 6; ++i) a[i] -= b[i];
    return a;
}

/// One contact with the velocities that it would have without its own impulses.
class Trial {
public:
    Trial(ContactBlock& block, const ContactVector& velocity)
        : block_{block},
          modal_{contact_vector(block, block.impulse)},
          free_{minus(velocity, times(block.matrix, modal_))},
          now_{velocity},
          answer_{block.impulse}
    {}

    /// Begins again with another velocity, as if it had been made with it.
    void begin_again(const ContactVector& velocity, const ContactVector& start)
    {
        answer_ = block_.impulse;
        modal_ = start;
        now_ = velocity;
        is_at_limit_ = has_settled_ = false;
    }
    /// True if slip() has found the solution.
    [[nodiscard]] bool has_settled() const { return has_settled_; }
    [[nodiscard]] const ContactImpulse& answer() const { return answer_; }
    [[nodiscard]] const ContactVector& impulse() const { return modal_; }
    /// Returns the velocities without the contact's own impulses.
    [[nodiscard]] const ContactVector& free() const { return free_; }

    void scale(double share)
    {
        for (double& impulse : answer_.normal) impulse *= share;
        set_friction(share * answer_.tangent_1, share * answer_.tangent_2, share * answer_.torsion);
        modal_ = contact_vector(block_, answer_);
    }

    /// Solves a sticking contact. Returns false when something would pull or friction would exceed
    /// its limit.
    bool stick(double tolerance);
    /// Solves a slipping or frictionless contact: finds the normal impulses for the present
    /// friction.
    void push(double tolerance)
    {
        set_given();
        push_for_friction(tolerance);
    }
    /// Solves a slipping contact, in at most `rounds_max` rounds. Returns false when friction does
    /// not reach its limit.
    bool slip(double tolerance, int rounds_max);

private:
    [[nodiscard]] bool opens(double tolerance);
    [[nodiscard]] PointSet pushing(double tolerance) const;
    [[nodiscard]] PointSet without_pulling(const PointSet& set) const;
    template <bool sticks>
    void hold_points(const PointSet& set);
    template <bool sticks>
    void hold_all(const PlaneFit& fit);
    template <bool sticks>
    void hold_few(const PointSet& set);
    template <std::size_t points, std::size_t frictions>
    void hold_exactly(const PointSet& set);
    /// Finds the velocities without the normal impulses, once for each friction.
    void set_given()
    {
        const auto& m = block_.matrix;
        put_two(two_of(&free_[0]) +
                    (both(modal_[3]) * two_of(&m[3][0]) + both(modal_[4]) * two_of(&m[4][0]) +
                     both(modal_[5]) * two_of(&m[5][0])),
                &given_[0]);
        given_[2] = free_[2] + (m[2][3] * modal_[3] + m[2][4] * modal_[4] + m[2][5] * modal_[5]);
    }
    void push_for_friction(double tolerance);
    void set_normals();
    void set_friction(double tangent_1, double tangent_2, double torsion)
    {
        answer_.tangent_1 = modal_[3] = tangent_1;
        answer_.tangent_2 = modal_[4] = tangent_2;
        answer_.torsion = modal_[5] = torsion;
    }
    void move_normals();
    void move_tangents();
    [[nodiscard]] Friction scaled_friction() const
    {
        return {answer_.tangent_1, answer_.tangent_2,
                block_.torsion_arm > 0.0 ? answer_.torsion / block_.torsion_arm : 0.0};
    }
    [[nodiscard]] double normal_sum() const
    {
        return answer_.normal[0] + answer_.normal[1] + answer_.normal[2] + answer_.normal[3];
    }
    [[nodiscard]] double load() const { return normal_sum() + block_.locked_load; }
    double slip_once(double step);
    [[nodiscard]] Friction within_limit(Friction f);

    ContactBlock& block_;
    ContactVector modal_; // modal impulses of the answer
    ContactVector free_;
    ContactVector now_;     // velocity with the answer
    ContactVector given_{}; // see set_given()
    ContactImpulse answer_;
    bool is_at_limit_ = false;
    bool has_settled_ = false;
};

PointSet Trial::pushing(double tolerance) const
{
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < manifold_points_max; ++i) {
        const double speed = block_.normal_speed(now_, i) - block_.speed_min[i];
        const auto pushes = static_cast<std::uint32_t>(answer_.normal[i] > 0.0);
        const auto has_to = static_cast<std::uint32_t>(speed < -tolerance);
        bits |= (pushes | has_to) << i;
    }
    return PointSet::of(bits & ((1U << block_.count) - 1U)); // bits beyond `count` are no points
}

PointSet Trial::without_pulling(const PointSet& set) const
{
    std::uint32_t bits = 0;
    for (std::uint32_t i = 0; i < manifold_points_max; ++i)
        bits |= static_cast<std::uint32_t>(answer_.normal[i] > 0.0) << i;
    return PointSet::of(bits & set.bits);
}

void Trial::set_normals()
{
    modal_[0] = modal_[1] = modal_[2] = 0.0;
    for (std::size_t i = 0; i < manifold_points_max; ++i) { // points that do not push add nothing
        modal_[0] += answer_.normal[i];
        modal_[1] += block_.along_2[i] * answer_.normal[i];
        modal_[2] -= block_.along_1[i] * answer_.normal[i];
    }
}

void Trial::move_normals()
{
    const auto& m = block_.matrix;
    put_two(two_of(&given_[0]) +
                (both(modal_[0]) * two_of(&m[0][0]) + both(modal_[1]) * two_of(&m[1][0]) +
                 both(modal_[2]) * two_of(&m[2][0])),
            &now_[0]);
    now_[2] = given_[2] + (m[2][0] * modal_[0] + m[2][1] * modal_[1] + m[2][2] * modal_[2]);
}

void Trial::move_tangents()
{
    for (std::size_t i = 3; i < 6; ++i) {
        const auto& row = block_.matrix[i];
        now_[i] = free_[i] + (row[0] * modal_[0] + row[1] * modal_[1] + row[2] * modal_[2] +
                              row[3] * modal_[3] + row[4] * modal_[4] + row[5] * modal_[5]);
    }
}

template <std::size_t points, std::size_t frictions>
void Trial::hold_exactly(const PointSet& set)
{
    const ContactVector& before = frictions > 0 ? free_ : given_;
    std::array<double, points + frictions> wanted{};
    for (std::size_t i = 0; i < points; ++i) {
        wanted[i] = block_.speed_min[set.at[i]] - block_.normal_speed(before, set.at[i]);
    }
    for (std::size_t i = 0; i < frictions; ++i) wanted[points + i] = -before[3 + i];
    const auto unknown = few_factors(block_, set).solve(wanted);
    answer_.normal = {};
    for (std::size_t i = 0; i < points; ++i) answer_.normal[set.at[i]] = unknown[i];
    if constexpr (frictions > 0) {
        set_friction(unknown[points], unknown[points + 1],
                     frictions > 2 ? unknown[points + frictions - 1] : 0.0);
    }
    set_normals();
}

template <bool sticks>
void Trial::hold_few(const PointSet& set)
{
    if constexpr (!sticks) {
        return set.count == 1 ? hold_exactly<1, 0>(set) : hold_exactly<2, 0>(set);
    } else {
        if (set.count == 1) return hold_exactly<1, 2>(set);
        return block_.torsion_arm == 0.0 ? hold_exactly<2, 2>(set) : hold_exactly<2, 3>(set);
    }
}

template <bool sticks>
void Trial::hold_all(const PlaneFit& fit)
{
    const std::array<double, 3> least = fit.modal_least(block_.speed_min);
    const Ldl<6>& factors = whole_factors(block_);
    const ContactVector& before = sticks ? free_ : given_;
    const std::array<double, 3> wanted{least[0] - before[0], least[1] - before[1],
                                       least[2] - before[2]};
    answer_.normal = {};
    if constexpr (sticks) {
        const auto unknown = factors.solve(
            ContactVector{wanted[0], wanted[1], wanted[2], -before[3], -before[4], -before[5]});
        fit.spread({unknown[0], unknown[1], unknown[2]}, answer_.normal);
        set_friction(unknown[3], unknown[4], unknown[5]);
    } else {
        fit.spread(factors.solve(wanted), answer_.normal);
    }
    set_normals();
}

template <bool sticks>
void Trial::hold_points(const PointSet& set)
{
    if (set.count == 0) {
        answer_.normal = {};
        modal_[0] = modal_[1] = modal_[2] = 0.0;
        if (sticks || block_.locked_load == 0.0) set_friction(0.0, 0.0, 0.0);
        set_given();
    } else if (set.count <= 2) {
        hold_few<sticks>(set);
    } else if (const PlaneFit& fit = fit_of(block_, set); fit.is_flat()) {
        hold_few<sticks>(outermost(block_, fit));
    } else {
        hold_all<sticks>(fit);
    }
}

bool Trial::stick(double tolerance)
{
    PointSet set = pushing(tolerance);
    for (;;) { // at most once for each point, and once without points
        hold_points<true>(set);
        // A contact that would have to pull to stick may still have to push to slip.
        if (set.count == 0) return opens(tolerance);
        const PointSet rest = without_pulling(set);
        if (rest.count == set.count) break;
        set = rest;
    }
    const Friction f = scaled_friction();
    const double limit = block_.friction * load();
    if (f[0] * f[0] + f[1] * f[1] + f[2] * f[2] > limit * limit) return false;
    return opens(tolerance);
}

/// True if all points are at their least speeds or faster, with the present solution.
bool Trial::opens(double tolerance)
{
    set_given();
    move_normals();
    for (std::uint32_t i = 0; i < block_.count; ++i) {
        if (block_.normal_speed(now_, i) - block_.speed_min[i] < -tolerance) return false;
    }
    return true;
}

void Trial::push_for_friction(double tolerance)
{
    PointSet set = pushing(tolerance);
    for (std::uint32_t round = 0; round < 2 * manifold_points_max; ++round) {
        hold_points<false>(set);
        const PointSet rest = without_pulling(set);
        if (rest.count < set.count) {
            set = rest;
            continue;
        }
        move_normals();
        if (set.count == 0) return;
        const PointSet more = pushing(tolerance);
        if (more.count == set.count) return;
        set = more;
    }
    for (double& impulse : answer_.normal) impulse = std::max(impulse, 0.0);
    modal_ = contact_vector(block_, answer_);
    move_normals();
}

/// Returns friction in this direction, reduced to the limit that the normal impulses allow.
Friction Trial::within_limit(Friction f)
{
    const double limit = block_.friction * load();
    const double size = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    is_at_limit_ = size > limit;
    if (is_at_limit_) {
        const double share = limit / size;
        for (double& part : f) part *= share;
    }
    return f;
}

/// Moves friction toward the direction against the slip. Returns the change.
double Trial::slip_once(double step)
{
    const double arm = block_.torsion_arm;
    const Friction was = scaled_friction();
    move_tangents();
    const Friction f = within_limit(
        {was[0] - step * now_[3], was[1] - step * now_[4], was[2] - step * now_[5] * arm});
    set_friction(f[0], f[1], f[2] * arm);
    set_given();
    move_normals();
    return std::max({std::abs(f[0] - was[0]), std::abs(f[1] - was[1]), std::abs(f[2] - was[2])});
}

bool Trial::slip(double tolerance, int rounds_max)
{
    const double step = slip_step(block_);
    constexpr double settled = 1e-14; // share of the impulses: rounding
    push(tolerance);
    bool reached = false;
    for (int round = 0; round < rounds_max; ++round) {
        const double change = slip_once(step);
        reached = is_at_limit_;
        push_for_friction(tolerance);
        has_settled_ = change <= settled * load();
        if (has_settled_) return reached;
    }
    const Friction f = within_limit(scaled_friction());
    set_friction(f[0], f[1], f[2] * block_.torsion_arm);
    return reached;
}

/// Returns the part of such speeds that may be rounding, m/s.
double rounding_of(const ContactBlock& block, const ContactVector& velocity)
{
    constexpr double share = 1e-13;
    return share * (std::abs(velocity[0]) + std::abs(velocity[3]) + std::abs(velocity[4]) +
                    block.torsion_arm *
                        (std::abs(velocity[1]) + std::abs(velocity[2]) + std::abs(velocity[5])));
}

/// Returns the share of a solution that is applied. Against the least speeds an exact solution does
/// no work at the end (points that push are at theirs, friction opposes the slip), so it leaves
/// less energy than no impulse would. A solution with rounding errors or with too few rounds must
/// not leave more. If it would, the share that leaves least is applied.
double dissipative_share(const ContactBlock& block, const Trial& trial)
{
    EnergyOfShare energy = energy_of(block, trial.impulse(), trial.free());
    for (std::size_t i = 0; i < block.count; ++i)
        energy.linear -= trial.answer().normal[i] * block.speed_min[i];
    constexpr double rounding = 2e-9;
    return energy.at(1.0) <= rounding * energy.square ? 1.0 : energy.share_of_least();
}

ContactVector finish(ContactBlock& block, Trial& trial, const ContactVector& start)
{
    if (const double share = dissipative_share(block, trial); !(share >= 1.0)) trial.scale(share);
    block.impulse = trial.answer();
    return minus(trial.impulse(), start);
}

} // namespace

bool normals_are_solved(const ContactBlock& block, const ContactVector& velocity, double tolerance)
{
    for (std::size_t i = 0; i < block.count; ++i) {
        const double excess = block.normal_speed(velocity, i) - block.speed_min[i];
        if (excess < -tolerance || (excess > tolerance && block.impulse.normal[i] > 0.0))
            return false;
        if (block.impulse.normal[i] < 0.0) return false;
    }
    return true;
}

bool is_solved(const ContactBlock& block, const ContactVector& velocity, double tolerance)
{
    if (!normals_are_solved(block, velocity, tolerance)) return false;
    if (block.friction == 0.0) return true;
    const double arm = block.torsion_arm;
    const double limit = block.friction_limit();
    const Friction slip{velocity[3], velocity[4], velocity[5] * arm};
    const Friction held{block.impulse.tangent_1, block.impulse.tangent_2,
                        arm > 0.0 ? block.impulse.torsion / arm : 0.0};
    const double speed2 = slip[0] * slip[0] + slip[1] * slip[1] + slip[2] * slip[2];
    const double held2 = held[0] * held[0] + held[1] * held[1] + held[2] * held[2];
    constexpr double rounding = 1e-12;
    if (held2 > limit * limit * (1.0 + rounding)) return false;
    if (speed2 <= tolerance * tolerance) return true;
    const double speed = std::sqrt(speed2);
    double miss2 = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double miss = held[i] * speed + limit * slip[i];
        miss2 += miss * miss;
    }
    return miss2 <= rounding * rounding * limit * limit * speed2;
}

bool is_slipping(const ContactBlock& block, const ContactVector& velocity, double tolerance)
{
    const ContactImpulse& held = block.impulse;
    const double along = held.tangent_1 * velocity[3] + held.tangent_2 * velocity[4];
    const double size2 = held.tangent_1 * held.tangent_1 + held.tangent_2 * held.tangent_2;
    const double limit = block.friction_limit();
    constexpr double nearly = 0.99;
    return size2 >= nearly * limit * limit && size2 > 0.0 && along < 0.0 &&
           along * along > tolerance * tolerance * size2;
}

ContactVector solve(ContactBlock& block, const ContactVector& velocity, double tolerance)
{
    if (block.friction == 0.0) return solve_normals(block, velocity, tolerance);
    const double still = std::max(tolerance, rounding_of(block, velocity));
    constexpr int rounds = 8;
    // A block that slipped at the end of the last tick usually continues to slip.
    const bool slips = is_slipping(block, velocity, still);
    Trial first{block, velocity};
    const ContactVector start = first.impulse();
    if (block.locked_load > 0.0) {
        first.slip(still, rounds);
        return finish(block, first, start);
    }
    if (slips) {
        if (first.slip(still, rounds) && first.has_settled()) return finish(block, first, start);
        Trial sticking = first;
        sticking.begin_again(velocity, start);
        return finish(block, sticking.stick(still) ? sticking : first, start);
    }
    if (first.stick(still)) return finish(block, first, start);
    first.begin_again(velocity, start);
    first.slip(still, rounds);
    return finish(block, first, start);
}

ContactVector iterate(ContactBlock& block, const ContactVector& velocity, double tolerance)
{
    if (block.friction == 0.0) return solve_normals(block, velocity, tolerance);
    const double still = std::max(tolerance, rounding_of(block, velocity));
    // A block that slipped usually continues to slip.
    bool& slipped = block.factors.slipped;
    Trial first{block, velocity};
    const ContactVector start = first.impulse();
    if (block.locked_load > 0.0) {
        first.slip(still, 1);
        return finish(block, first, start);
    }
    if (slipped) {
        if (first.slip(still, 1)) return finish(block, first, start);
        Trial sticking = first;
        sticking.begin_again(velocity, start);
        slipped = !sticking.stick(still);
        return finish(block, slipped ? first : sticking, start);
    }
    if (first.stick(still)) return finish(block, first, start);
    slipped = true;
    first.begin_again(velocity, start);
    first.slip(still, 1);
    return finish(block, first, start);
}

ContactVector solve_normals(ContactBlock& block, const ContactVector& velocity, double tolerance)
{
    Trial trial{block, velocity};
    const ContactVector start = trial.impulse();
    trial.push(std::max(tolerance, rounding_of(block, velocity)));
    return finish(block, trial, start);
}

} // namespace hapnet::scene

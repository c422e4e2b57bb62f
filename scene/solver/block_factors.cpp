// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/block_factors.hpp"

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

/// Whether another set of so many points was met last.
bool is_new(BlockFactors& factors, const PointSet& set)
{
    std::uint32_t& known = factors.sets[set.count - 1];
    const bool is_new = known != set.bits();
    known = set.bits();
    return is_new;
}

} // namespace

const Ldl<5>& few_factors(ContactBlock& block, const PointSet& set)
{
    Ldl<5>& few = block.factors.few[set.count - 1];
    if (is_new(block.factors, set)) few = factors_of(block, set);
    return few;
}

const Ldl<6>& whole_factors(ContactBlock& block)
{
    BlockFactors& factors = block.factors;
    if (!factors.has_whole) factors.whole = Ldl<6>{block.matrix};
    factors.has_whole = true;
    return factors.whole;
}

const PlaneFit& fit_of(ContactBlock& block, const PointSet& set)
{
    PlaneFit& fit = block.factors.fits[set.count - 3];
    if (is_new(block.factors, set)) fit = PlaneFit{block.along_1, block.along_2, set};
    return fit;
}

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

double slip_answer(const ContactBlock& block)
{
    const double arm = block.torsion_arm;
    const auto& m = block.matrix;
    const double coupled_1 = std::abs(m[5][3]) * arm;
    const double coupled_2 = std::abs(m[5][4]) * arm;
    const double across = std::abs(m[4][3]);
    return std::max({m[3][3] + across + coupled_1, m[4][4] + across + coupled_2,
                     m[5][5] * arm * arm + coupled_1 + coupled_2});
}

} // namespace hapnet::scene

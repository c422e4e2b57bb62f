// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/experiment/summary.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

namespace {

void raise(std::optional<double>& worst, std::optional<double> value)
{
    if (value) worst = std::max(worst.value_or(*value), *value);
}

void lower(std::optional<double>& worst, std::optional<double> value)
{
    if (value) worst = std::min(worst.value_or(*value), *value);
}

std::optional<double> vibration_at(const std::optional<ByOrder>& values, FilterOrder order)
{
    return values ? std::optional{at_order(*values, order)} : std::nullopt;
}

void take_worst(Summary& summary, const Scores& scores, FilterOrder order)
{
    if (scores.discrepancy_m) raise(summary.discrepancy_max_m, scores.discrepancy_m->max);
    raise(summary.vibration_m, vibration_at(scores.vibration_m, order));
    lower(summary.stiffness_ratio, scores.stiffness_ratio[judged_press]);
    raise(summary.force_vibration_n, vibration_at(scores.force_vibration_n, order));
    raise(summary.force_discrepancy, scores.force_discrepancy);
    raise(summary.contact_lost, scores.contact_lost);
    if (scores.force_steps) raise(summary.force_step_n, scores.force_steps->largest_n);
    raise(summary.drag_n, scores.drag_n);
    raise(summary.energy_j, scores.energy_taken_j);
}

std::optional<Spread> mean_spread(std::span<const Scores> all)
{
    Spread sum;
    double count = 0.0;
    for (const Scores& scores : all) {
        if (!scores.discrepancy_m) continue;
        sum.mean += scores.discrepancy_m->mean;
        sum.min += scores.discrepancy_m->min;
        sum.max += scores.discrepancy_m->max;
        sum.std += scores.discrepancy_m->std;
        count += 1.0;
    }
    if (count == 0.0) return std::nullopt;
    return Spread{sum.mean / count, sum.min / count, sum.max / count, sum.std / count};
}

} // namespace

Summary summary_of(std::span<const Scores> scores, const Criteria& criteria)
{
    Summary summary;
    summary.typical_m = mean_spread(scores);
    bool is_first = true;
    for (const Scores& one : scores) {
        take_worst(summary, one, criteria.filter_order);
        const Judgement judgement = judge(one, criteria);
        if (!is_first && judgement.tier >= summary.tier) continue;
        is_first = false;
        summary.tier = judgement.tier;
        const auto& reasons =
            judgement.failures.empty() ? judgement.shortcomings : judgement.failures;
        summary.limited_by = fmt::format("{}", fmt::join(reasons, "; "));
    }
    return summary;
}

} // namespace hapnet::lab

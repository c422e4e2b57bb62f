// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/summary.hpp"

#include "lab/metrics/subjects.hpp"
#include "lab/metrics/worse.hpp"
#include "proto/base/quantity.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::lab::results {

namespace {

void raise(std::optional<double>& worst, std::optional<double> value)
{
    if (value) worst = std::max(worst.value_or(*value), *value);
}

void lower(std::optional<double>& worst, std::optional<double> value)
{
    if (value) worst = std::min(worst.value_or(*value), *value);
}

std::optional<double> vibration_at(const std::optional<metrics::ByOrder>& values,
                                   metrics::FilterOrder order)
{
    return values ? std::optional{at_order(*values, order)} : std::nullopt;
}

void raise(std::optional<metrics::ByOrder>& worst, const std::optional<metrics::ByOrder>& values)
{
    if (!values) return;
    const metrics::ByOrder so_far = worst.value_or(*values);
    worst = metrics::ByOrder{std::max(so_far.first, values->first),
                             std::max(so_far.second, values->second),
                             std::max(so_far.fourth, values->fourth)};
}

/// Returns scores that are in every respect as bad as the worst of all.
metrics::Scores worst_of(std::span<const metrics::Scores> all)
{
    metrics::Scores worst = all.front();
    for (const metrics::Scores& scores : all.subspan(1)) {
        worst.scored_share = std::min(worst.scored_share, scores.scored_share);
        raise(worst.vibration_m, scores.vibration_m);
        lower(worst.stiffness_ratio[metrics::judged_press],
              scores.stiffness_ratio[metrics::judged_press]);
        raise(worst.stiffness_error, scores.stiffness_error);
        raise(worst.slow_stiffness_error, scores.slow_stiffness_error);
        raise(worst.force_discrepancy, scores.force_discrepancy);
        worst.discrepancy_m = metrics::worse(worst.discrepancy_m, scores.discrepancy_m);
        worst.turned_apart_rad = metrics::worse(worst.turned_apart_rad, scores.turned_apart_rad);
        raise(worst.force_vibration_n, scores.force_vibration_n);
        raise(worst.force_vibration_added_n, scores.force_vibration_added_n);
        raise(worst.force_above_2hz_added_n, scores.force_above_2hz_added_n);
        raise(worst.contact_lost, scores.contact_lost);
        raise(worst.drag_n, scores.drag_n);
        raise(worst.energy_taken_j, scores.energy_taken_j);
        raise(worst.rate_bit_per_s, scores.rate_bit_per_s);
    }
    return worst;
}

/// Returns a figure of the discrepancy for each seed or subject that has one.
std::vector<double> discrepancies(std::span<const metrics::Scores> all,
                                  std::span<const std::string> subjects,
                                  double metrics::Spread::*figure)
{
    metrics::SubjectMeans means;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (!all[i].discrepancy_m) continue;
        const auto subject = subjects.empty() ? std::nullopt : std::optional{subjects[i]};
        means.add(subject, *all[i].discrepancy_m.*figure);
    }
    return means.means();
}

std::optional<metrics::Spread> mean_spread(std::span<const metrics::Scores> all,
                                           std::span<const std::string> subjects)
{
    const auto mean = [&](double metrics::Spread::*figure) {
        double sum = 0.0;
        const auto values = discrepancies(all, subjects, figure);
        for (const double value : values) sum += value;
        return sum / static_cast<double>(values.size());
    };
    using metrics::Spread;
    if (discrepancies(all, subjects, &Spread::mean).empty()) return std::nullopt;
    return Spread{mean(&Spread::mean), mean(&Spread::min), mean(&Spread::max), mean(&Spread::std)};
}

} // namespace

Summary summarize(std::span<const metrics::Scores> scores, const metrics::Criteria& criteria,
                  std::span<const std::string> subjects)
{
    Summary summary{.typical_m = mean_spread(scores, subjects), .worst = worst_of(scores)};
    const auto means_m = discrepancies(scores, subjects, &metrics::Spread::mean);
    for (const metrics::Scores& one : scores) {
        if (judge(one, criteria).tier != metrics::Tier::unusable) ++summary.usable;
        if (one.discrepancy_m) raise(summary.discrepancy_max_m, one.discrepancy_m->max);
        if (one.turned_apart_rad) raise(summary.turned_apart_max_rad, one.turned_apart_rad->max);
        if (one.force_steps) raise(summary.force_step_n, one.force_steps->largest_n);
    }
    if (means_m.size() > 1) summary.mean_m = metrics::interval_of_mean(means_m);
    const metrics::Judgement judgement = judge(summary.worst, criteria);
    summary.tier = judgement.tier;
    const auto& reasons = judgement.failures.empty() ? judgement.shortcomings : judgement.failures;
    summary.limited_by = fmt::format("{}", fmt::join(reasons, "; "));
    return summary;
}

Judged make_judged(const Summary& summary, const metrics::Criteria& criteria)
{
    const auto vibration_m = vibration_at(summary.worst.vibration_m, criteria.filter_order);
    Judged judged{.stiffness_ratio = summary.worst.stiffness_ratio[metrics::judged_press],
                  .force_vibration_n =
                      vibration_at(summary.worst.force_vibration_n, criteria.filter_order),
                  .tier = summary.tier};
    if (summary.typical_m) judged.mean_mm = 1e3 * summary.typical_m->mean;
    if (vibration_m) judged.vibration_mm = 1e3 * *vibration_m;
    if (const auto turned = summary.worst.turned_apart_rad)
        judged.turned_apart_deg = turned->mean / base::radians_per_degree;
    judged.stiffness_error = summary.worst.stiffness_error;
    judged.slow_stiffness_error = summary.worst.slow_stiffness_error;
    return judged;
}

} // namespace hapnet::lab::results

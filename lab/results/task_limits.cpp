// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/task_limits.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::lab::results {

namespace {

/// True if `a` is a worse limit: a lower one, or an equal one that was found while `b` is open.
bool is_worse(const TaskLimit& a, const TaskLimit& b)
{
    const auto rank = [](const TaskLimit& one) {
        return std::tuple{!one.fails_at_rest, one.threshold.p50, one.threshold.is_open};
    };
    return rank(a) < rank(b);
}

/// Returns the metrics by which a session misses the tier.
std::vector<std::string_view> failed_metrics(const metrics::Scores& scores, metrics::Tier tier,
                                             const metrics::Criteria& criteria)
{
    metrics::Judgement judgement = judge(scores, criteria);
    if (tier == metrics::Tier::good) {
        judgement.failed.insert(judgement.failed.end(), judgement.short_of.begin(),
                                judgement.short_of.end());
    }
    return judgement.failed;
}

/// Returns TaskLimit::decided_by.
std::string_view decided_by(const experiment::SearchResult& search, const TaskLimit& limit,
                            const metrics::Criteria& criteria)
{
    if (limit.threshold.is_open) return {};
    std::vector<std::pair<std::string_view, std::size_t>> counts; // failures by metric
    std::optional<experiment::ImpairmentLevel> level;
    for (const experiment::CurvePoint& point : search.curve) {
        const bool is_failure = point.counts && point.tier < limit.tier;
        if (!is_failure || in_units(point.level) < limit.threshold.p50) continue;
        if (!level) level = point.level;
        if (*level != point.level) break;
        for (const std::string_view metric : failed_metrics(point.scores, limit.tier, criteria)) {
            const auto known =
                std::ranges::find(counts, metric, [](auto& one) { return one.first; });
            if (known == counts.end()) {
                counts.emplace_back(metric, 1);
            } else {
                ++known->second;
            }
        }
    }
    const auto most = std::ranges::max_element(counts, {}, [](auto& one) { return one.second; });
    return most == counts.end() ? std::string_view{} : most->first;
}

bool fails_at_rest(const std::vector<metrics::LevelOutcome>& outcomes)
{
    const metrics::LevelOutcome& lowest = outcomes.front();
    const auto failed = static_cast<std::size_t>(std::ranges::count(lowest.failed, true));
    return lowest.level == 0.0 && 2 * failed >= lowest.failed.size();
}

/// Returns TaskLimit::message_bits. At level N of the interval there is a message in every N ticks.
std::optional<double> message_bits(const experiment::SearchJob& job,
                                   const experiment::SearchResult& search, base::Duration tick)
{
    if (job.range.impairment != experiment::Impairment::interval) return std::nullopt;
    for (const experiment::CurvePoint& point : search.curve) {
        const auto& rate = point.scores.rate_bit_per_s;
        if (rate && point.level.thousandths > 0)
            return *rate * base::to_seconds(tick) * in_units(point.level);
    }
    return std::nullopt;
}

/// Returns the limits of a task, one for each tier.
std::vector<TaskLimit> limits_of(const experiment::SearchJob& job,
                                 const experiment::SearchResult& search,
                                 const experiment::Experiment& experiment,
                                 const metrics::Criteria& criteria)
{
    const auto& tiers = std::get<experiment::Limits>(experiment.kind).tiers;
    std::vector<TaskLimit> limits;
    for (std::size_t i = 0; i < tiers.size(); ++i) {
        const auto& outcomes = search.outcomes[i];
        TaskLimit& limit = limits.emplace_back(
            TaskLimit{.algorithm = &experiment.algorithms[job.algorithm],
                      .impairment = job.range.impairment,
                      .task = name_of(job.task),
                      .party = job.party,
                      .tier = tiers[i],
                      .threshold = metrics::threshold_of(outcomes, in_units(job.range.to)),
                      .fails_at_rest = fails_at_rest(outcomes),
                      .message_bits = message_bits(job, search, experiment.tick)});
        limit.decided_by = decided_by(search, limit, criteria);
    }
    return limits;
}

} // namespace

std::vector<TaskLimit> task_limits(const experiment::Experiment& experiment,
                                   const metrics::Criteria& criteria,
                                   std::span<const experiment::JobResult> results)
{
    const auto jobs = make_jobs(experiment);
    std::vector<TaskLimit> limits;
    std::vector<std::vector<TaskLimit>> by_tier(
        std::get<experiment::Limits>(experiment.kind).tiers.size());
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto* job = std::get_if<experiment::SearchJob>(&jobs[i]);
        if (job == nullptr) continue;
        const auto& search = std::get<experiment::SearchResult>(results[i]);
        const auto of_task = limits_of(*job, search, experiment, criteria);
        for (std::size_t tier = 0; tier < by_tier.size(); ++tier)
            by_tier[tier].push_back(of_task[tier]);
        if (job->task != experiment.tasks.back()) continue;
        for (std::vector<TaskLimit>& of_tasks : by_tier) {
            TaskLimit worst = *std::ranges::min_element(of_tasks, is_worse);
            worst.task = worst_task;
            limits.insert(limits.end(), of_tasks.begin(), of_tasks.end());
            limits.push_back(std::move(worst));
            of_tasks.clear();
        }
    }
    return limits;
}

std::string p50_of(experiment::Impairment impairment, metrics::Tier tier)
{
    const auto name = fmt::format("p50 of {}, {}", name_of(impairment), unit_of(impairment));
    return tier == metrics::Tier::usable ? name : fmt::format("{}, {}", name, to_text(tier));
}

std::optional<metrics::Tier> tier_cell(const experiment::Experiment& experiment, metrics::Tier tier)
{
    const std::vector usual{metrics::Tier::usable};
    if (std::get<experiment::Limits>(experiment.kind).tiers == usual) return std::nullopt;
    return tier;
}

} // namespace hapnet::lab::results

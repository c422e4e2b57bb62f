// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/limit_tables.hpp"

#include "lab/results/paper.hpp"
#include "lab/results/party_columns.hpp"
#include "lab/results/shipped.hpp"
#include "lab/results/summary.hpp"
#include "lab/results/task_limits.hpp"

#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::lab::results {

namespace {

Bound bound_of(const metrics::Threshold& threshold)
{
    return threshold.is_open ? Bound::open : Bound::found;
}

const TaskLimit* limit_of(const std::vector<TaskLimit>& limits, const TaskLimit& like,
                          std::string_view algorithm)
{
    for (const TaskLimit& other : limits) {
        if (other.algorithm->name == algorithm && other.impairment == like.impairment &&
            other.task == like.task && other.party == like.party && other.tier == like.tier) {
            return &other;
        }
    }
    return nullptr;
}

/// The paper's statement on a limit. It refers to two people and to no task in particular.
struct PaperCells {
    std::optional<double> limit{};
    LimitStatus status{};
    Provenance provenance{};
};
PaperCells paper_cells(const std::vector<TaskLimit>& limits, const TaskLimit& one)
{
    const std::string& name = one.algorithm->name;
    PaperCells cells{.provenance = limit_provenance(name, one.impairment, one.task)};
    if (one.task != worst_task) return cells;
    cells.limit = paper_limit(name, one.impairment);
    const TaskLimit* base = limit_of(limits, one, "base");
    const bool is_ours = base == nullptr || is_built_in(*base->algorithm);
    cells.status = limit_status(name, one.impairment, one.threshold,
                                base != nullptr && is_ours ? &base->threshold : nullptr);
    return cells;
}

} // namespace

Table limits_table(const experiment::Experiment& experiment, const metrics::Criteria& criteria,
                   std::span<const experiment::JobResult> results)
{
    Table table{"limits",
                columns_in(fmt::format("algorithm,impairment,task,limit:2,bound,unit,paper_limit,"
                                       "status,class,p50:2,p10:2,ci_low:2,ci_high:2,seeds,{},tier?,"
                                       "band+,decided_by",
                                       party_columns))};
    const auto limits = task_limits(experiment, criteria, results);
    const bool is_shipped = plays_as_shipped(experiment, criteria, "fig6a");
    for (const TaskLimit& one : limits) {
        const metrics::Threshold& threshold = one.threshold;
        // The paper states what was accepted: that corresponds to the tier usable.
        const bool is_papers =
            is_shipped && is_built_in(*one.algorithm) && one.tier == metrics::Tier::usable;
        const PaperCells paper = is_papers ? paper_cells(limits, one) : PaperCells{};
        const auto party = party_cells(experiment, one.party);
        const bool has_band = is_papers && one.task == worst_task && !party.peers && !party.scene;
        const auto impairment = name_of(one.impairment);
        table.add(one.algorithm->name, impairment, one.task, threshold.p50, bound_of(threshold),
                  unit_of(one.impairment), paper.limit, paper.status, paper.provenance,
                  threshold.p50, threshold.p10, threshold.low, threshold.high, threshold.seeds,
                  party.peers, party.scene, tier_cell(experiment, one.tier),
                  has_band ? limit_band(one.algorithm->name, impairment) : std::string_view{},
                  one.decided_by);
    }
    return table;
}

Table paired_limits_table(const experiment::Experiment& experiment,
                          const metrics::Criteria& criteria,
                          std::span<const experiment::JobResult> results)
{
    Table table{"paired", columns_in(paired_columns)};
    const auto limits = task_limits(experiment, criteria, results);
    const std::string& reference = experiment.algorithms.front().name;
    for (const TaskLimit& one : limits) {
        const TaskLimit* against = limit_of(limits, one, reference);
        if (one.algorithm->name == reference || against == nullptr) continue;
        const auto difference = difference_of(one.threshold, against->threshold);
        table.add(one.algorithm->name, reference, one.task, p50_of(one.impairment, one.tier),
                  one.threshold.seeds, difference.value, difference.interval.low,
                  difference.interval.high, std::optional<double>{});
    }
    return table;
}

Table curves_table(const experiment::Experiment& experiment, const metrics::Criteria& criteria,
                   std::span<const experiment::JobResult> results)
{
    Table table{"curves",
                columns_in(fmt::format("algorithm,impairment,task,level,unit,seed,counts,{},{},{}",
                                       judged_columns, party_columns, stiffness_error_columns))};
    const auto jobs = make_jobs(experiment);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto* job = std::get_if<experiment::SearchJob>(&jobs[i]);
        if (job == nullptr) continue;
        const auto party = party_cells(experiment, job->party);
        const experiment::Impairment impairment = job->range.impairment;
        for (const experiment::CurvePoint& point :
             std::get<experiment::SearchResult>(results[i]).curve) {
            const Judged judged =
                make_judged(summarize(std::span{&point.scores, 1}, criteria), criteria);
            table.add(experiment.algorithms[job->algorithm].name, name_of(impairment),
                      name_of(job->task), in_units(point.level), unit_of(impairment), point.seed,
                      point.counts, judged.mean_mm, judged.vibration_mm, judged.stiffness_ratio,
                      judged.force_vibration_n, point.tier, judged.turned_apart_deg, party.peers,
                      party.scene, judged.stiffness_error, judged.slow_stiffness_error);
        }
    }
    return table;
}

Table sensitivity_table(const experiment::Experiment& experiment,
                        const experiment::Sensitivity& sensitivity,
                        std::span<const experiment::JobResult> results)
{
    Table table{"limits_by_convention",
                columns_in(fmt::format("algorithm,impairment,task,filter_order,hand,limit:2,bound,"
                                       "unit,ci_low:2,ci_high:2,seeds,{}",
                                       party_columns))};
    const auto jobs = make_jobs(experiment);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto* job = std::get_if<experiment::SensitivityJob>(&jobs[i]);
        if (job == nullptr) continue;
        const auto party = party_cells(experiment, job->party);
        const auto& outcomes = std::get<experiment::SensitivityResult>(results[i]).outcomes;
        for (std::size_t order = 0; order < outcomes.size(); ++order) {
            const auto threshold = metrics::threshold_of(outcomes[order], in_units(job->range.to));
            table.add(experiment.algorithms[job->algorithm].name, name_of(job->range.impairment),
                      name_of(job->task), count_of(sensitivity.filter_orders[order]),
                      name_of(job->hands), threshold.p50, bound_of(threshold),
                      unit_of(job->range.impairment), threshold.low, threshold.high,
                      threshold.seeds, party.peers, party.scene);
        }
    }
    return table;
}

} // namespace hapnet::lab::results

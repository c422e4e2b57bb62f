// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/limit_rows.hpp"

#include "lab/results/paper.hpp"
#include "lab/results/party_columns.hpp"
#include "lab/results/shipped.hpp"
#include "lab/results/summary.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <tuple>

namespace hapnet::lab::results {

namespace {

/// The threshold of one task, or of the worst of them.
struct TaskLimit {
    const experiment::NamedAlgorithm* algorithm = nullptr;
    experiment::Impairment impairment{};
    std::string_view task;
    experiment::Party party{};
    metrics::Threshold threshold{};
};

/// Less, and found rather than not.
bool is_worse(const metrics::Threshold& a, const metrics::Threshold& b)
{
    return std::tuple{a.p50, a.is_open} < std::tuple{b.p50, b.is_open};
}

/// The tasks of an algorithm and impairment, and after them the worst.
std::vector<TaskLimit> limits_of(const experiment::Experiment& experiment,
                                 std::span<const experiment::JobResult> results)
{
    const auto jobs = make_jobs(experiment);
    std::vector<TaskLimit> limits;
    std::optional<TaskLimit> worst;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto* job = std::get_if<experiment::SearchJob>(&jobs[i]);
        if (job == nullptr) continue;
        const auto& outcomes = std::get<experiment::SearchResult>(results[i]).outcomes;
        limits.push_back({&experiment.algorithms[job->algorithm], job->range.impairment,
                          name_of(job->task), job->party,
                          metrics::threshold_of(outcomes, in_units(job->range.to))});
        if (!worst || is_worse(limits.back().threshold, worst->threshold)) {
            worst = limits.back();
            worst->task = worst_task;
        }
        if (job->task != experiment.tasks.back()) continue;
        limits.push_back(*worst);
        worst.reset();
    }
    return limits;
}

Bound bound_of(const metrics::Threshold& threshold)
{
    return threshold.is_open ? Bound::open : Bound::found;
}

const TaskLimit* limit_of(const std::vector<TaskLimit>& limits, const TaskLimit& like,
                          std::string_view algorithm)
{
    for (const TaskLimit& other : limits) {
        if (other.algorithm->name == algorithm && other.impairment == like.impairment &&
            other.task == like.task && other.party == like.party) {
            return &other;
        }
    }
    return nullptr;
}

/// What the paper says of a row: it says it of two people and of no task in particular.
void note_paper(const std::vector<TaskLimit>& limits, const TaskLimit& one, LimitRow& row)
{
    row.provenance = limit_provenance(one.algorithm->name, one.impairment, one.task);
    if (one.task != worst_task) return;
    row.paper_limit = paper_limit(one.algorithm->name, one.impairment);
    const TaskLimit* base = limit_of(limits, one, "base");
    const bool is_ours = base == nullptr || is_built_in(*base->algorithm);
    row.status = limit_status(one.algorithm->name, one.impairment, one.threshold,
                              base != nullptr && is_ours ? &base->threshold : nullptr);
}

} // namespace

std::vector<LimitRow> make_limit_rows(const experiment::Experiment& experiment,
                                      const metrics::Criteria& criteria,
                                      std::span<const experiment::JobResult> results)
{
    std::vector<LimitRow> rows;
    const auto limits = limits_of(experiment, results);
    const bool is_shipped = plays_as_shipped(experiment, criteria, "fig6a");
    for (const TaskLimit& one : limits) {
        const metrics::Threshold& threshold = one.threshold;
        LimitRow row{.algorithm = one.algorithm->name,
                     .impairment = std::string{name_of(one.impairment)},
                     .task = std::string{one.task},
                     .limit = threshold.p50,
                     .bound = bound_of(threshold),
                     .unit = std::string{unit_of(one.impairment)},
                     .p50 = threshold.p50,
                     .p10 = threshold.p10,
                     .ci_low = threshold.low,
                     .ci_high = threshold.high,
                     .seeds = threshold.seeds};
        if (is_shipped && is_built_in(*one.algorithm)) note_paper(limits, one, row);
        note_party(experiment, one.party, row);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<PairedRow> make_paired_limit_rows(const experiment::Experiment& experiment,
                                              std::span<const experiment::JobResult> results)
{
    std::vector<PairedRow> rows;
    const auto limits = limits_of(experiment, results);
    const std::string& reference = experiment.algorithms.front().name;
    for (const TaskLimit& one : limits) {
        const TaskLimit* against = limit_of(limits, one, reference);
        if (one.algorithm->name == reference || against == nullptr) continue;
        const auto difference = difference_of(one.threshold, against->threshold);
        rows.push_back({.algorithm = one.algorithm->name,
                        .reference = reference,
                        .task = std::string{one.task},
                        .measure = fmt::format("p50 of {}, {}", name_of(one.impairment),
                                               unit_of(one.impairment)),
                        .seeds = one.threshold.seeds,
                        .difference = difference.value,
                        .ci_low = difference.interval.low,
                        .ci_high = difference.interval.high,
                        .sign_test_p = std::nullopt});
    }
    return rows;
}

std::vector<CurveRow> make_curve_rows(const experiment::Experiment& experiment,
                                      const metrics::Criteria& criteria,
                                      std::span<const experiment::JobResult> results)
{
    std::vector<CurveRow> rows;
    const auto jobs = make_jobs(experiment);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto* job = std::get_if<experiment::SearchJob>(&jobs[i]);
        if (job == nullptr) continue;
        const experiment::Impairment impairment = job->range.impairment;
        for (const experiment::CurvePoint& point :
             std::get<experiment::SearchResult>(results[i]).curve) {
            Judged judged = make_judged(summarize(std::span{&point.scores, 1}, criteria), criteria);
            judged.tier = point.tier;
            rows.push_back({.algorithm = experiment.algorithms[job->algorithm].name,
                            .impairment = std::string{name_of(impairment)},
                            .task = std::string{name_of(job->task)},
                            .level = in_units(point.level),
                            .unit = std::string{unit_of(impairment)},
                            .seed = point.seed,
                            .counts = point.counts,
                            .judged = judged});
            note_party(experiment, job->party, rows.back());
        }
    }
    return rows;
}

std::vector<SensitivityRow> make_sensitivity_rows(const experiment::Experiment& experiment,
                                                  const experiment::Sensitivity& sensitivity,
                                                  std::span<const experiment::JobResult> results)
{
    std::vector<SensitivityRow> rows;
    const auto jobs = make_jobs(experiment);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto* job = std::get_if<experiment::SensitivityJob>(&jobs[i]);
        if (job == nullptr) continue;
        const auto& outcomes = std::get<experiment::SensitivityResult>(results[i]).outcomes;
        for (std::size_t order = 0; order < outcomes.size(); ++order) {
            const auto threshold = metrics::threshold_of(outcomes[order], in_units(job->range.to));
            rows.push_back({.algorithm = experiment.algorithms[job->algorithm].name,
                            .impairment = std::string{name_of(job->range.impairment)},
                            .task = std::string{name_of(job->task)},
                            .filter_order = count_of(sensitivity.filter_orders[order]),
                            .hand = name_of(job->hands),
                            .limit = threshold.p50,
                            .bound = bound_of(threshold),
                            .unit = std::string{unit_of(job->range.impairment)},
                            .ci_low = threshold.low,
                            .ci_high = threshold.high,
                            .seeds = threshold.seeds});
            note_party(experiment, job->party, rows.back());
        }
    }
    return rows;
}

} // namespace hapnet::lab::results

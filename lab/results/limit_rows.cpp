// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/limit_rows.hpp"

#include "lab/results/paper.hpp"
#include "lab/results/party_columns.hpp"
#include "lab/results/summary.hpp"

#include <tuple>

namespace hapnet::lab::results {

namespace {

/// The limit that a search found, in one task or in the worst of them.
struct TaskLimit {
    std::string_view algorithm;
    experiment::Impairment impairment{};
    std::string_view task;
    experiment::Party party{};
    experiment::Limit limit{};

    /// As the paper plays.
    [[nodiscard]] bool is_usual() const { return party == experiment::Party{}; }
};

/// Less, and found rather than not.
bool is_worse(const experiment::Limit& a, const experiment::Limit& b)
{
    return std::tuple{a.level, !a.ever_failed} < std::tuple{b.level, !b.ever_failed};
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
        const std::string_view algorithm = experiment.algorithms[job->algorithm].name;
        const experiment::Limit& limit = std::get<experiment::SearchResult>(results[i]).limit;
        limits.push_back({algorithm, job->range.impairment, name_of(job->task), job->party, limit});
        if (!worst || is_worse(limit, worst->limit)) {
            worst = TaskLimit{algorithm, job->range.impairment, worst_task, job->party, limit};
        }
        if (job->task != experiment.tasks.back()) continue;
        limits.push_back(*worst);
        worst.reset();
    }
    return limits;
}

FoundLimit in_unit(const experiment::Limit& limit)
{
    return {in_units(limit.level), limit.ever_failed};
}

Bound bound_of(const experiment::Limit& limit)
{
    return limit.ever_failed ? Bound::found : Bound::open;
}

std::optional<FoundLimit> base_of(const std::vector<TaskLimit>& limits, const TaskLimit& like)
{
    for (const TaskLimit& other : limits) {
        if (other.algorithm == "base" && other.impairment == like.impairment &&
            other.task == like.task && other.party == like.party) {
            return in_unit(other.limit);
        }
    }
    return std::nullopt;
}

} // namespace

std::vector<LimitRow> make_limit_rows(const experiment::Experiment& experiment,
                                      std::span<const experiment::JobResult> results)
{
    std::vector<LimitRow> rows;
    const auto limits = limits_of(experiment, results);
    for (const TaskLimit& one : limits) {
        LimitRow row{.algorithm = std::string{one.algorithm},
                     .impairment = std::string{name_of(one.impairment)},
                     .task = std::string{one.task},
                     .limit = in_units(one.limit.level),
                     .bound = bound_of(one.limit),
                     .unit = std::string{unit_of(one.impairment)}};
        if (one.is_usual()) {
            row.paper_limit = paper_limit(one.algorithm, one.impairment);
            row.status = limit_status(one.algorithm, one.impairment, in_unit(one.limit),
                                      base_of(limits, one));
        }
        note_party(experiment, one.party, row);
        rows.push_back(std::move(row));
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
        const auto& limits = std::get<experiment::SensitivityResult>(results[i]).limits;
        for (std::size_t order = 0; order < limits.size(); ++order) {
            rows.push_back({.algorithm = experiment.algorithms[job->algorithm].name,
                            .impairment = std::string{name_of(job->range.impairment)},
                            .task = std::string{name_of(job->task)},
                            .filter_order = count_of(sensitivity.filter_orders[order]),
                            .hand = name_of(job->hands),
                            .limit = in_units(limits[order].level),
                            .bound = bound_of(limits[order]),
                            .unit = std::string{unit_of(job->range.impairment)}});
            note_party(experiment, job->party, rows.back());
        }
    }
    return rows;
}

} // namespace hapnet::lab::results

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/limit_rows.hpp"

#include "lab/results/paper.hpp"
#include "lab/results/summary.hpp"

#include <tuple>

namespace hapnet::lab {

namespace {

/// The limit that a search found, in one task or in the worst of them.
struct TaskLimit {
    std::string_view algorithm;
    Impairment impairment{};
    std::string_view task;
    Limit limit{};
};

/// Less, and found rather than not.
bool is_worse(const Limit& a, const Limit& b)
{
    return std::tuple{a.level, !a.ever_failed} < std::tuple{b.level, !b.ever_failed};
}

/// The tasks of an algorithm and impairment, and after them the worst.
std::vector<TaskLimit> limits_of(const Experiment& experiment, std::span<const Finding> findings)
{
    const auto parts = parts_of(experiment);
    std::vector<TaskLimit> limits;
    std::optional<TaskLimit> worst;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto* part = std::get_if<SearchPart>(&parts[i]);
        if (part == nullptr) continue;
        const std::string_view algorithm = experiment.algorithms[part->algorithm].name;
        const Limit& limit = std::get<SearchFinding>(findings[i]).limit;
        limits.push_back({algorithm, part->range.impairment, name_of(part->task), limit});
        if (!worst || is_worse(limit, worst->limit)) {
            worst = TaskLimit{algorithm, part->range.impairment, worst_task, limit};
        }
        if (part->task != experiment.tasks.back()) continue;
        limits.push_back(*worst);
        worst.reset();
    }
    return limits;
}

FoundLimit in_unit(const Limit& limit) { return {in_units(limit.level), limit.ever_failed}; }

Bound bound_of(const Limit& limit) { return limit.ever_failed ? Bound::found : Bound::open; }

std::optional<FoundLimit> base_of(const std::vector<TaskLimit>& limits, const TaskLimit& like)
{
    for (const TaskLimit& other : limits) {
        if (other.algorithm == "base" && other.impairment == like.impairment &&
            other.task == like.task) {
            return in_unit(other.limit);
        }
    }
    return std::nullopt;
}

} // namespace

std::vector<LimitRow> make_limit_rows(const Experiment& experiment,
                                      std::span<const Finding> findings)
{
    std::vector<LimitRow> rows;
    const auto limits = limits_of(experiment, findings);
    for (const TaskLimit& one : limits) {
        rows.push_back({.algorithm = std::string{one.algorithm},
                        .impairment = std::string{name_of(one.impairment)},
                        .task = std::string{one.task},
                        .limit = in_units(one.limit.level),
                        .bound = bound_of(one.limit),
                        .unit = std::string{unit_of(one.impairment)},
                        .paper_limit = paper_limit(one.algorithm, one.impairment),
                        .status = limit_status(one.algorithm, one.impairment, in_unit(one.limit),
                                               base_of(limits, one))});
    }
    return rows;
}

std::vector<CurveRow> make_curve_rows(const Experiment& experiment, const Criteria& criteria,
                                      std::span<const Finding> findings)
{
    std::vector<CurveRow> rows;
    const auto parts = parts_of(experiment);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto* part = std::get_if<SearchPart>(&parts[i]);
        if (part == nullptr) continue;
        const Impairment impairment = part->range.impairment;
        for (const CurvePoint& point : std::get<SearchFinding>(findings[i]).curve) {
            Judged judged =
                make_judged(summary_of(std::span{&point.scores, 1}, criteria), criteria);
            judged.tier = point.tier;
            rows.push_back({.algorithm = experiment.algorithms[part->algorithm].name,
                            .impairment = std::string{name_of(impairment)},
                            .task = std::string{name_of(part->task)},
                            .level = in_units(point.level),
                            .unit = std::string{unit_of(impairment)},
                            .seed = point.seed,
                            .judged = judged});
        }
    }
    return rows;
}

std::vector<ConventionRow> make_convention_rows(const Experiment& experiment,
                                                const Convention& convention,
                                                std::span<const Finding> findings)
{
    std::vector<ConventionRow> rows;
    const auto parts = parts_of(experiment);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto* part = std::get_if<ConventionPart>(&parts[i]);
        if (part == nullptr) continue;
        const auto& limits = std::get<ConventionFinding>(findings[i]).limits;
        for (std::size_t order = 0; order < limits.size(); ++order) {
            rows.push_back({.algorithm = experiment.algorithms[part->algorithm].name,
                            .impairment = std::string{name_of(part->range.impairment)},
                            .task = std::string{name_of(part->task)},
                            .filter_order = count_of(convention.filter_orders[order]),
                            .hand = name_of(part->hands),
                            .limit = in_units(limits[order].level),
                            .bound = bound_of(limits[order]),
                            .unit = std::string{unit_of(part->range.impairment)}});
        }
    }
    return rows;
}

} // namespace hapnet::lab

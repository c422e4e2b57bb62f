// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/limits_csv.hpp"

#include "lab/results/cells.hpp"
#include "lab/results/paper.hpp"
#include "lab/results/summary.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <tuple>

namespace hapnet::lab {

namespace {

constexpr std::string_view worst_task = "worst";

struct LimitRow {
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
std::vector<LimitRow> rows_of(const Experiment& experiment, std::span<const Finding> findings)
{
    const auto parts = parts_of(experiment);
    std::vector<LimitRow> rows;
    std::optional<LimitRow> worst;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto* part = std::get_if<SearchPart>(&parts[i]);
        if (part == nullptr) continue;
        const std::string_view algorithm = experiment.algorithms[part->algorithm].name;
        const Limit& limit = std::get<SearchFinding>(findings[i]).limit;
        rows.push_back({algorithm, part->range.impairment, name_of(part->task), limit});
        if (!worst || is_worse(limit, worst->limit)) {
            worst = LimitRow{algorithm, part->range.impairment, worst_task, limit};
        }
        if (part->task != experiment.tasks.back()) continue;
        rows.push_back(*worst);
        worst.reset();
    }
    return rows;
}

FoundLimit in_unit(const Limit& limit) { return {in_units(limit.level), limit.ever_failed}; }

std::string_view bound_of(const Limit& limit) { return limit.ever_failed ? "=" : ">"; }

std::optional<FoundLimit> base_of(const std::vector<LimitRow>& rows, const LimitRow& row)
{
    for (const LimitRow& other : rows) {
        if (other.algorithm == "base" && other.impairment == row.impairment &&
            other.task == row.task) {
            return in_unit(other.limit);
        }
    }
    return std::nullopt;
}

} // namespace

std::string limits_csv(const Experiment& experiment, std::span<const Finding> findings)
{
    std::string out = "algorithm,impairment,task,limit,bound,unit,paper_limit,status\n";
    const auto rows = rows_of(experiment, findings);
    for (const LimitRow& row : rows) {
        const auto paper = paper_limit(row.algorithm, row.impairment);
        out += fmt::format(
            "{},{},{},{},{},{},{},{}\n", row.algorithm, name_of(row.impairment), row.task,
            to_text(row.limit.level), bound_of(row.limit), unit_of(row.impairment),
            paper ? fmt::format("{}", *paper) : "",
            limit_status(row.algorithm, row.impairment, in_unit(row.limit), base_of(rows, row)));
    }
    return out;
}

std::string curves_csv(const Experiment& experiment, const Criteria& criteria,
                       std::span<const Finding> findings)
{
    std::string out = "algorithm,impairment,task,level,unit,seed,mean_mm,vibration_mm,"
                      "stiffness_ratio,force_vibration_n,tier\n";
    const auto parts = parts_of(experiment);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto* part = std::get_if<SearchPart>(&parts[i]);
        if (part == nullptr) continue;
        const Impairment impairment = part->range.impairment;
        for (const CurvePoint& point : std::get<SearchFinding>(findings[i]).curve) {
            const Summary one = summary_of(std::span{&point.scores, 1}, criteria);
            out += fmt::format(
                "{},{},{},{},{},{},{},{},{},{},{}\n", experiment.algorithms[part->algorithm].name,
                name_of(impairment), name_of(part->task), to_text(point.level), unit_of(impairment),
                point.seed,
                milli_cell(one.typical_m ? std::optional{one.typical_m->mean} : std::nullopt),
                milli_cell(vibration_m(one, criteria)),
                number_cell(one.worst.stiffness_ratio[judged_press]),
                number_cell(force_vibration_n(one, criteria)), to_text(point.tier));
        }
    }
    return out;
}

std::string convention_csv(const Experiment& experiment, const Convention& convention,
                           std::span<const Finding> findings)
{
    std::string out = "algorithm,impairment,task,filter_order,hand,limit,bound,unit\n";
    const auto parts = parts_of(experiment);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto* part = std::get_if<ConventionPart>(&parts[i]);
        if (part == nullptr) continue;
        const auto& limits = std::get<ConventionFinding>(findings[i]).limits;
        for (std::size_t order = 0; order < limits.size(); ++order) {
            out += fmt::format("{},{},{},{},{},{},{},{}\n",
                               experiment.algorithms[part->algorithm].name,
                               name_of(part->range.impairment), name_of(part->task),
                               count_of(convention.filter_orders[order]),
                               text_cell(name_of(part->hands)), to_text(limits[order].level),
                               bound_of(limits[order]), unit_of(part->range.impairment));
        }
    }
    return out;
}

} // namespace hapnet::lab

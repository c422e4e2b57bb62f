// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/precision_rows.hpp"

#include "lab/metrics/precision.hpp"
#include "lab/results/session_rows.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <variant>

namespace hapnet::lab::results {

namespace {

/// A figure at one value of the axis.
struct Figure {
    std::string algorithm;
    std::string task;
    std::string name;
    std::uint32_t seeds = 0;
    std::uint64_t ticks = 0; // by all seeds
    double found = 0.0;      // by all seeds
    std::function<std::vector<double>(std::size_t draws)> replicates;

    [[nodiscard]] bool is_same_as(const Figure& other) const
    {
        return algorithm == other.algorithm && task == other.task && name == other.name &&
               seeds == other.seeds;
    }
};

struct SessionFigure {
    std::string_view name;
    std::optional<double> SessionRow::*value;
    bool is_of_p1 = false; // the figures of Table 1
    bool is_of_tasks = false;
};
constexpr std::array session_figures{
    SessionFigure{"mean_mm", &SessionRow::mean_mm, true, true},
    SessionFigure{"std_mm", &SessionRow::std_mm, true, false},
    SessionFigure{"max_mm", &SessionRow::max_mm, true, false},
    SessionFigure{"vibration_mm", &SessionRow::vibration_mm, false, true},
    SessionFigure{"stiffness_ratio", &SessionRow::stiffness_ratio, false, true},
    SessionFigure{"force_vibration_n", &SessionRow::force_vibration_n, false, true}};

/// Of all players in so many sessions.
std::uint64_t ticks_of(const experiment::Experiment& experiment, std::size_t sessions)
{
    const auto each = static_cast<std::uint64_t>(experiment.duration / experiment.tick);
    return each * experiment.peers.front() * sessions;
}

/// The values of all seeds; empty when one has none.
std::vector<double> values_of(std::span<const SessionRow> sessions,
                              std::optional<double> SessionRow::*value)
{
    std::vector<double> values;
    for (const SessionRow& row : sessions) {
        if (!(row.*value)) return {};
        values.push_back(*(row.*value));
    }
    return values;
}

/// Of the sessions of one algorithm and task.
void add_session_figures(const experiment::Experiment& experiment,
                         std::span<const SessionRow> sessions, std::vector<Figure>& figures)
{
    const bool is_p1 = sessions.front().task == "P1";
    for (const SessionFigure& one : session_figures) {
        if (!(is_p1 ? one.is_of_p1 : one.is_of_tasks)) continue;
        auto values = values_of(sessions, one.value);
        if (values.empty()) continue;
        const double sum = std::accumulate(values.begin(), values.end(), 0.0);
        Figure& figure = figures.emplace_back();
        figure.algorithm = sessions.front().algorithm;
        figure.task = sessions.front().task;
        figure.name = one.name;
        figure.seeds = static_cast<std::uint32_t>(values.size());
        figure.ticks = ticks_of(experiment, 2 * values.size());
        figure.found = sum / static_cast<double>(values.size());
        figure.replicates = [values = std::move(values)](std::size_t draws) {
            return metrics::mean_replicates(values, draws);
        };
    }
}

void add_limit(const experiment::Experiment& experiment, const experiment::SearchJob& job,
               const experiment::SearchResult& result, std::vector<Figure>& figures)
{
    const double top = in_units(job.range.to);
    const auto threshold = metrics::threshold_of(result.outcomes, top);
    if (threshold.is_open) return;
    Figure& figure = figures.emplace_back();
    figure.algorithm = experiment.algorithms[job.algorithm].name;
    figure.task = name_of(job.task);
    figure.name =
        fmt::format("p50 of {}, {}", name_of(job.range.impairment), unit_of(job.range.impairment));
    figure.seeds = threshold.seeds;
    figure.ticks = ticks_of(experiment, result.curve.size() + threshold.seeds);
    figure.found = threshold.p50;
    figure.replicates = [outcomes = result.outcomes](std::size_t draws) {
        return metrics::p50_replicates(outcomes, draws);
    };
}

std::vector<Figure> figures_of(const AxisFindings& findings, const metrics::Criteria& criteria)
{
    const experiment::Experiment& experiment = *findings.experiment;
    std::vector<Figure> figures;
    if (std::holds_alternative<experiment::Limits>(experiment.kind)) {
        const auto jobs = make_jobs(experiment);
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            const auto* search = std::get_if<experiment::SearchJob>(&jobs[i]);
            if (search == nullptr) continue;
            add_limit(experiment, *search, std::get<experiment::SearchResult>(findings.results[i]),
                      figures);
        }
        return figures;
    }
    const auto sessions = make_session_rows(experiment, criteria, findings.results);
    for (auto begin = sessions.begin(); begin != sessions.end();) {
        const auto end = std::find_if(begin, sessions.end(), [&](const SessionRow& row) {
            return row.algorithm != begin->algorithm || row.task != begin->task;
        });
        add_session_figures(experiment, {begin, end}, figures);
        begin = end;
    }
    return figures;
}

/// 1, 2, 5, 10, 20, ... below so many, and all.
std::vector<std::uint32_t> numbers_of_seeds(std::uint32_t all)
{
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t decade = 1; decade < all; decade *= 10) {
        for (const std::uint32_t step : {1U, 2U, 5U}) {
            if (step * decade < all) numbers.push_back(step * decade);
        }
    }
    numbers.push_back(all);
    return numbers;
}

void add_rows(const Figure& figure, const Figure& reference, const PrecisionRow& common,
              std::vector<PrecisionRow>& rows)
{
    PrecisionRow row = common;
    row.algorithm = figure.algorithm;
    row.task = figure.task;
    row.figure = figure.name;
    row.found = figure.found;
    row.difference = figure.found - reference.found;
    if (figure.seeds > 1) {
        const auto interval = metrics::paired_interval(
            figure.replicates(figure.seeds), reference.replicates(figure.seeds), figure.seeds);
        row.ci_low = interval.low;
        row.ci_high = interval.high;
    }
    for (const std::uint32_t seeds : numbers_of_seeds(figure.seeds)) {
        const double error =
            metrics::root_mean_square_error(figure.replicates(seeds), reference.found);
        row.error = std::isfinite(error) ? std::optional{error} : std::nullopt;
        row.seeds = seeds;
        row.ticks = figure.ticks / figure.seeds * seeds;
        rows.push_back(row);
    }
}

} // namespace

std::vector<PrecisionRow> make_precision_rows(const experiment::Axis& axis,
                                              std::span<const AxisFindings> values,
                                              const metrics::Criteria& criteria)
{
    std::vector<std::vector<Figure>> figures;
    for (const AxisFindings& one : values) figures.push_back(figures_of(one, criteria));
    const auto of_reference = std::ranges::find(values, *axis.reference, &AxisFindings::value);
    base::ensure(of_reference != values.end());
    PrecisionRow common;
    common.parameter = axis.key;
    common.reference = *axis.reference;
    std::vector<PrecisionRow> rows;
    for (const Figure& reference :
         figures[static_cast<std::size_t>(of_reference - values.begin())]) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            common.value = values[i].value;
            const auto found = std::ranges::find_if(
                figures[i], [&](const Figure& one) { return one.is_same_as(reference); });
            if (found != figures[i].end()) add_rows(*found, reference, common, rows);
        }
    }
    return rows;
}

} // namespace hapnet::lab::results

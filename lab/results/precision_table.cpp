// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/precision_table.hpp"

#include "lab/metrics/precision.hpp"
#include "lab/results/session_rows.hpp"
#include "lab/results/task_limits.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <functional>
#include <numeric>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <system_error>
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
    std::uint64_t ticks = 0; // ticks of all seeds together
    double found = 0.0;      // the figure over all seeds
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
    bool is_of_p1 = false; // true if Table 1 has the figure
    bool is_of_tasks = false;
};
constexpr std::array session_figures{
    SessionFigure{"mean_mm", &SessionRow::mean_mm, true, true},
    SessionFigure{"std_mm", &SessionRow::std_mm, true, false},
    SessionFigure{"max_mm", &SessionRow::max_mm, true, false},
    SessionFigure{"vibration_mm", &SessionRow::vibration_mm, false, true},
    SessionFigure{"stiffness_ratio", &SessionRow::stiffness_ratio, false, true},
    SessionFigure{"force_vibration_n", &SessionRow::force_vibration_n, false, true}};

/// Returns the number of ticks of all players in `sessions` sessions.
std::uint64_t ticks_of(const experiment::Experiment& experiment, std::size_t sessions)
{
    const auto each = static_cast<std::uint64_t>(experiment.duration / experiment.tick);
    return each * experiment.peers.front() * sessions;
}

/// Returns the values of all seeds; empty when a seed has none.
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

/// Adds the figures of the sessions of one algorithm and task.
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

void add_limits(const experiment::Experiment& experiment, const experiment::SearchJob& job,
                const experiment::SearchResult& result, std::vector<Figure>& figures)
{
    const auto& tiers = std::get<experiment::Limits>(experiment.kind).tiers;
    for (std::size_t i = 0; i < tiers.size(); ++i) {
        const auto& outcomes = result.outcomes[i];
        const auto threshold = metrics::threshold_of(outcomes, in_units(job.range.to));
        if (threshold.is_open) continue;
        Figure& figure = figures.emplace_back();
        figure.algorithm = experiment.algorithms[job.algorithm].name;
        figure.task = name_of(job.task);
        figure.name = p50_of(job.range.impairment, tiers[i]);
        figure.seeds = threshold.seeds;
        figure.ticks = ticks_of(experiment, result.curve.size() + threshold.seeds);
        figure.found = threshold.p50;
        figure.replicates = [outcomes](std::size_t draws) {
            return metrics::p50_replicates(outcomes, draws);
        };
    }
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
            add_limits(experiment, *search, std::get<experiment::SearchResult>(findings.results[i]),
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

/// Returns 1, 2, 5, 10, 20, ... below `all`, and `all` itself.
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

/// A figure at a value of the axis, compared with the reference's.
struct ComparedFigure {
    std::string value;
    const Figure* figure = nullptr;
    double difference = 0.0;
    std::optional<metrics::Interval> interval{}; // interval of the difference; nullopt: one seed
};

ComparedFigure compared(const std::string& value, const Figure& figure, const Figure& reference)
{
    ComparedFigure one{value, &figure, figure.found - reference.found};
    if (figure.seeds > 1) {
        one.interval = metrics::paired_interval(figure.replicates(figure.seeds),
                                                reference.replicates(figure.seeds), figure.seeds);
    }
    return one;
}

/// The parts of a text such as "0.5ms"; nullopt: it is not a number.
struct Measured {
    double number = 0.0;
    std::string_view unit;
};
std::optional<Measured> measured(std::string_view text)
{
    Measured value;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value.number);
    if (error != std::errc{} || !(value.number > 0.0)) return std::nullopt;
    value.unit = text.substr(static_cast<std::size_t>(end - text.data()));
    return value;
}

/// Returns the order in which a figure converges, from the differences that chance does not
/// explain; nullopt also when they change their sign.
std::optional<double> order_of_figure(const std::string& reference,
                                      const std::vector<ComparedFigure>& by_value)
{
    const auto finest = measured(reference);
    std::vector<metrics::StepError> errors;
    bool is_above = false, is_below = false;
    for (const ComparedFigure& one : by_value) {
        const auto step = measured(one.value);
        const bool is_sure = !one.interval || one.interval->low > 0.0 || one.interval->high < 0.0;
        if (one.value == reference || !is_sure || one.difference == 0.0) continue;
        if (!step || !finest || step->unit != finest->unit) return std::nullopt;
        is_above = is_above || one.difference > 0.0;
        is_below = is_below || one.difference < 0.0;
        errors.push_back({step->number, std::abs(one.difference)});
    }
    if (!finest || (is_above && is_below)) return std::nullopt;
    return metrics::order_of(errors, finest->number);
}

void add_rows(const experiment::Axis& axis, const Figure& reference,
              const std::vector<ComparedFigure>& by_value, Table& table)
{
    const auto order = order_of_figure(*axis.reference, by_value);
    for (const ComparedFigure& one : by_value) {
        const Figure& figure = *one.figure;
        const auto low = one.interval ? std::optional{one.interval->low} : std::nullopt;
        const auto high = one.interval ? std::optional{one.interval->high} : std::nullopt;
        for (const std::uint32_t seeds : numbers_of_seeds(figure.seeds)) {
            table.add(
                figure.algorithm, figure.task, figure.name, axis.key, one.value, *axis.reference,
                seeds, figure.ticks / figure.seeds * seeds, figure.found, one.difference, low, high,
                metrics::root_mean_square_error(figure.replicates(seeds), reference.found), order);
        }
    }
}

} // namespace

Table precision_table(const experiment::Axis& axis, std::span<const AxisFindings> values,
                      const metrics::Criteria& criteria)
{
    std::vector<std::vector<Figure>> figures;
    for (const AxisFindings& one : values) figures.push_back(figures_of(one, criteria));
    const auto of_reference = std::ranges::find(values, *axis.reference, &AxisFindings::value);
    base::ensure(of_reference != values.end());
    Table table{"precision",
                columns_in("algorithm,task,figure,parameter,value,reference,seeds,ticks,found:6,"
                           "difference:6,ci_low:6,ci_high:6,error:6,order+")};
    for (const Figure& reference :
         figures[static_cast<std::size_t>(of_reference - values.begin())]) {
        std::vector<ComparedFigure> by_value;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const auto found = std::ranges::find_if(
                figures[i], [&](const Figure& one) { return one.is_same_as(reference); });
            if (found != figures[i].end())
                by_value.push_back(compared(values[i].value, *found, reference));
        }
        add_rows(axis, reference, by_value, table);
    }
    return table;
}

} // namespace hapnet::lab::results

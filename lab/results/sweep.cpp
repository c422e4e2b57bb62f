// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/sweep.hpp"

#include "lab/metrics/json.hpp"
#include "proto/base/fields_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>
#include <string_view>
#include <utility>

namespace hapnet::lab::results {

namespace {

using Json = nlohmann::ordered_json;

std::optional<double> percent_of(std::optional<double> real, std::optional<double> simulated)
{
    if (!real || !simulated || *simulated == 0.0) return std::nullopt;
    return 100.0 * (*real - *simulated) / *simulated;
}

std::optional<double> farther(std::optional<double> a, std::optional<double> b)
{
    if (!a || !b) return a ? a : b;
    return std::abs(*a) >= std::abs(*b) ? a : b;
}

std::string number(std::optional<double> value, int decimals)
{
    return value ? fmt::format("{:.{}f}", *value, decimals) : std::string{};
}

std::vector<Cell> condition_cells(const SweepRow& row)
{
    const SessionRow& one = row.real;
    return {row.point,
            one.algorithm,
            one.task,
            one.hands,
            to_cell(one.peers),
            one.scene,
            one.duration_s,
            to_cell(one.delay_ms),
            to_cell(one.jitter_ms),
            to_cell(one.loss_percent),
            to_cell(one.burst_of_100),
            one.network,
            one.seed};
}

/// A measure by which real time and virtual time are compared.
struct SweepMeasure {
    std::string_view name;
    std::optional<double> SessionRow::*value;
};
constexpr std::array sweep_measures{
    SweepMeasure{"mean_mm", &SessionRow::mean_mm},
    SweepMeasure{"std_mm", &SessionRow::std_mm},
    SweepMeasure{"max_mm", &SessionRow::max_mm},
    SweepMeasure{"vibration_mm", &SessionRow::vibration_mm},
    SweepMeasure{"stiffness_ratio", &SessionRow::stiffness_ratio},
    SweepMeasure{"force_vibration_n", &SessionRow::force_vibration_n}};

void add_measures(const SessionRow& row, std::vector<Cell>& cells)
{
    for (const SweepMeasure& measure : sweep_measures) cells.push_back(to_cell(row.*measure.value));
    cells.push_back(to_cell(row.tier));
}

/// Returns all cells of a condition but the seed.
std::vector<Cell> condition_of(const SweepRow& row)
{
    auto cells = condition_cells(row);
    cells.pop_back();
    return cells;
}

/// The sessions of one condition.
struct Condition {
    std::vector<const SweepRow*> valid; // at most one session for each seed
    std::uint32_t left_out = 0;
};

/// Stores one attempt for each seed, a valid one if there is any.
void note(const SweepRow& row, std::map<std::uint64_t, const SweepRow*>& by_seed)
{
    const SweepRow*& kept = by_seed[row.real.seed];
    if (kept == nullptr || (!kept->is_valid && row.is_valid)) kept = &row;
}

double mean_over(const std::vector<double>& values)
{
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

/// Compares a measure. The row stays empty where no session has the measure.
void compare(const Condition& condition, const SweepMeasure& measure, ConditionRow& row)
{
    std::vector<double> real, simulated;
    for (const SweepRow* one : condition.valid) {
        const auto a = one->real.*measure.value, b = one->simulated.*measure.value;
        if (!a || !b) continue;
        real.push_back(*a);
        simulated.push_back(*b);
    }
    row.measure = measure.name;
    if (real.empty()) return;
    row.real = mean_over(real);
    row.simulated = mean_over(simulated);
    row.difference_percent = percent_of(row.real, row.simulated);
    if (!row.difference_percent || real.size() < 2) return;
    const auto test = metrics::paired_test(real, simulated);
    row.ci_low_percent = 100.0 * test.interval.low / *row.simulated;
    row.ci_high_percent = 100.0 * test.interval.high / *row.simulated;
}

} // namespace

Json to_json(const PlayedCell& played)
{
    return {{"valid", played.valid()},
            {"invalid_because", played.invalid_because},
            {"missed_ticks", played.missed_ticks},
            {"longest_gap_ms", played.longest_gap_ms},
            {"real", metrics::to_json(played.real)},
            {"virtual", metrics::to_json(played.simulated)},
            {"perfect", metrics::to_json(played.perfect)}};
}

base::Result<PlayedCell> played_cell_from(const nlohmann::json& json)
{
    PlayedCell played;
    for (auto [key, into] : {std::pair{"real", &played.real},
                             {"virtual", &played.simulated},
                             {"perfect", &played.perfect}}) {
        auto metrics = metrics::metrics_from(json.value(key, nlohmann::json::object()));
        if (!metrics) return base::fail(fmt::format("'{}' has no metrics", key));
        *into = *std::move(metrics);
    }
    const auto member = [&](const char* key, nlohmann::json otherwise) {
        return json.value(key, std::move(otherwise));
    };
    if (!base::read_json(member("missed_ticks", 0U), played.missed_ticks))
        return base::fail("'missed_ticks' is no count");
    if (!base::read_json(member("longest_gap_ms", 0.0), played.longest_gap_ms) ||
        played.longest_gap_ms < 0.0)
        return base::fail("'longest_gap_ms' is no time");
    if (!base::read_json(member("invalid_because", {}), played.invalid_because))
        return base::fail("'invalid_because' is no list of texts");
    return played;
}

SweepRow make_sweep_row(const SweepCell& cell, const PlayedCell& played,
                        const metrics::Criteria& criteria)
{
    const auto row_of = [&](const metrics::Metrics& metrics) {
        return make_session_row(cell.experiment, cell.job, scores_of(metrics, played.perfect),
                                criteria);
    };
    return {.point = cell.point,
            .real = row_of(played.real),
            .simulated = row_of(played.simulated),
            .missed_ticks = played.missed_ticks,
            .longest_gap_ms = played.longest_gap_ms,
            .is_valid = played.valid(),
            .invalid_because = fmt::format("{}", fmt::join(played.invalid_because, "; "))};
}

Table sweep_table(std::span<const SweepRow> rows)
{
    Table table{
        "real_time_sessions",
        columns_in("point,algorithm,task,hands,peers,scene,duration_s,delay_ms,jitter_ms,"
                   "loss_percent,burst_of_100,network,seed,attempt,mean_mm:4,std_mm:4,max_mm:4,"
                   "vibration_mm:4,stiffness_ratio:4,force_vibration_n:4,tier,virtual_mean_mm:4,"
                   "virtual_std_mm:4,virtual_max_mm:4,virtual_vibration_mm:4,"
                   "virtual_stiffness_ratio:4,virtual_force_vibration_n:4,virtual_tier,"
                   "difference_percent:2,vibration_difference_percent:2,missed_ticks,"
                   "longest_gap_ms:1,valid,invalid_because")};
    for (const SweepRow& row : rows) {
        auto& cells = table.rows.emplace_back(condition_cells(row));
        cells.push_back(to_cell(row.attempt));
        add_measures(row.real, cells);
        add_measures(row.simulated, cells);
        const auto percent = [&](std::optional<double> SessionRow::*value) {
            return row.is_valid ? percent_of(row.real.*value, row.simulated.*value) : std::nullopt;
        };
        cells.push_back(
            to_cell(farther(percent(&SessionRow::mean_mm), percent(&SessionRow::std_mm))));
        cells.push_back(to_cell(percent(&SessionRow::vibration_mm)));
        for (const Cell& cell : {to_cell(row.missed_ticks), to_cell(row.longest_gap_ms),
                                 to_cell(row.is_valid), to_cell(row.invalid_because)})
            cells.push_back(cell);
    }
    return table;
}

std::vector<ConditionRow> make_condition_rows(std::span<const SweepRow> rows)
{
    std::vector<std::vector<Cell>> order;
    std::map<std::vector<Cell>, std::map<std::uint64_t, const SweepRow*>> conditions;
    for (const SweepRow& row : rows) {
        const auto condition = condition_of(row);
        if (!conditions.contains(condition)) order.push_back(condition);
        note(row, conditions[condition]);
    }
    std::vector<ConditionRow> compared;
    for (const std::vector<Cell>& name : order) {
        Condition condition;
        for (const auto& [seed, row] : conditions[name]) {
            if (row->is_valid) {
                condition.valid.push_back(row);
            } else {
                ++condition.left_out;
            }
        }
        const SweepRow& first = *conditions[name].begin()->second;
        for (const SweepMeasure& measure : sweep_measures) {
            ConditionRow row{.point = first.point,
                             .algorithm = first.real.algorithm,
                             .task = first.real.task,
                             .hands = first.real.hands,
                             .peers = first.real.peers,
                             .scene = first.real.scene,
                             .duration_s = first.real.duration_s,
                             .network = first.real.network,
                             .sessions = static_cast<std::uint32_t>(condition.valid.size()),
                             .left_out = condition.left_out};
            compare(condition, measure, row);
            compared.push_back(std::move(row));
        }
    }
    return compared;
}

std::string conditions_table(std::span<const ConditionRow> rows)
{
    constexpr auto line = "{:<16}{:<5}{:>6}{:>9}  {:<18}{:>10}{:>10}{:>9}  {}\n";
    std::string table = fmt::format(line, "", "task", "peers", "sessions", "measure", "real",
                                    "virtual", "differs", "95 % interval");
    for (const ConditionRow& row : rows) {
        if (!row.real && row.sessions > 0) continue;
        if (row.sessions == 0 && row.measure != sweep_measures.front().name) continue;
        table += fmt::format(
            line, row.algorithm, row.task, row.peers, row.sessions, row.measure,
            row.real ? number(row.real, 3) : "-", row.simulated ? number(row.simulated, 3) : "-",
            row.difference_percent ? fmt::format("{:+.1f} %", *row.difference_percent) : "-",
            row.ci_low_percent
                ? fmt::format("{:+.1f} to {:+.1f} %", *row.ci_low_percent, *row.ci_high_percent)
            : row.left_out > 0 ? fmt::format("{} NOT VALID, excluded", row.left_out)
                               : "");
    }
    return table;
}

} // namespace hapnet::lab::results

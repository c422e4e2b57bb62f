// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/rows.hpp"

#include <array>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

template <typename Value, std::size_t count>
using Words = std::array<std::pair<std::string_view, Value>, count>;

constexpr Words<Claim, 4> verdicts{{{"", Claim::none},
                                    {"calibrated", Claim::calibrated},
                                    {"met", Claim::met},
                                    {"missed", Claim::missed}}};
constexpr Words<Claim, 4> statuses{{{"", Claim::none},
                                    {"calibrated", Claim::calibrated},
                                    {"predicted-met", Claim::met},
                                    {"predicted-missed", Claim::missed}}};
constexpr Words<bool, 2> bounds{{{"=", false}, {">", true}}};
constexpr Words<Rating, 3> ratings{
    {{"unusable", Rating::unusable}, {"usable", Rating::usable}, {"good", Rating::good}}};

Judged judged_of(Row& row)
{
    return {.mean_mm = row.number_if_any("mean_mm"),
            .vibration_mm = row.number_if_any("vibration_mm"),
            .stiffness_ratio = row.number_if_any("stiffness_ratio"),
            .force_vibration_n = row.number_if_any("force_vibration_n"),
            .tier = row.one_of<Rating>("tier", ratings)};
}

/// The error of a line that the rows cannot name any more: `index` counts from the header.
template <typename Value>
base::Result<Value> fail_at_row(const File& file, std::size_t index, std::string_view what)
{
    return base::fail(fmt::format("{}:{}: {}", file.path, index + 2, what));
}

struct ReplayRow {
    double time_s = 0.0;
    std::array<double, replay_columns.size()> values{};
};

ReplayRow replay_row(Row& row)
{
    ReplayRow out{.time_s = row.number("time_s")};
    for (std::size_t i = 0; i < replay_columns.size(); ++i) {
        out.values[i] = row.number(replay_columns[i]);
    }
    return out;
}

} // namespace

base::Result<std::vector<Table1Row>> read_table1(const File& file)
{
    return rows_of<Table1Row>(file, [](Row& row) {
        return Table1Row{.algorithm = row.text("algorithm"),
                         .mean_mm = row.number("mean_mm"),
                         .min_mm = row.number("min_mm"),
                         .max_mm = row.number("max_mm"),
                         .std_mm = row.number("std_mm"),
                         .paper_mean_mm = row.number_if_any("paper_mean_mm"),
                         .paper_max_mm = row.number_if_any("paper_max_mm"),
                         .paper_std_mm = row.number_if_any("paper_std_mm"),
                         .verdict = row.one_of<Claim>("verdict", verdicts)};
    });
}

base::Result<std::vector<TaskRow>> read_tasks(const File& file)
{
    return rows_of<TaskRow>(file, [](Row& row) {
        return TaskRow{.algorithm = row.text("algorithm"),
                       .task = row.text("task"),
                       .seeds = row.number("seeds"),
                       .judged = judged_of(row),
                       .std_mm = row.number_if_any("std_mm"),
                       .max_mm = row.number_if_any("max_mm"),
                       .force_discrepancy = row.number_if_any("force_discrepancy"),
                       .contact_lost = row.number_if_any("contact_lost"),
                       .force_step_n = row.number_if_any("force_step_n"),
                       .drag_n = row.number_if_any("drag_n"),
                       .energy_mj = row.number_if_any("energy_mj"),
                       .limited_by = row.text("limited_by")};
    });
}

base::Result<std::vector<LimitRow>> read_limits(const File& file)
{
    return rows_of<LimitRow>(file, [](Row& row) {
        return LimitRow{.algorithm = row.text("algorithm"),
                        .impairment = row.text("impairment"),
                        .task = row.text("task"),
                        .limit = row.number("limit"),
                        .is_open = row.one_of<bool>("bound", bounds),
                        .unit = row.text("unit"),
                        .paper_limit = row.number_if_any("paper_limit"),
                        .status = row.one_of<Claim>("status", statuses)};
    });
}

base::Result<std::vector<ConventionRow>> read_conventions(const File& file)
{
    return rows_of<ConventionRow>(file, [](Row& row) {
        return ConventionRow{.algorithm = row.text("algorithm"),
                             .impairment = row.text("impairment"),
                             .task = row.text("task"),
                             .filter_order = row.number("filter_order"),
                             .hand = row.text("hand"),
                             .limit = row.number("limit"),
                             .is_open = row.one_of<bool>("bound", bounds),
                             .unit = row.text("unit")};
    });
}

base::Result<std::vector<CurveRow>> read_curves(const File& file)
{
    return rows_of<CurveRow>(file, [](Row& row) {
        return CurveRow{.algorithm = row.text("algorithm"),
                        .impairment = row.text("impairment"),
                        .task = row.text("task"),
                        .level = row.number("level"),
                        .unit = row.text("unit"),
                        .judged = judged_of(row)};
    });
}

base::Result<std::vector<TrajectoryRow>> read_trajectories(const File& file)
{
    auto rows = rows_of<TrajectoryRow>(file, [](Row& row) {
        return TrajectoryRow{.algorithm = row.text("algorithm"),
                             .time_s = row.number("time_s"),
                             .cube_l_mm = row.number("cube_l_mm"),
                             .cube_r_mm = row.number("cube_r_mm"),
                             .hand_l_mm = row.number("hand_l_mm"),
                             .hand_r_mm = row.number("hand_r_mm"),
                             .force_l_n = row.number("force_l_n"),
                             .force_r_n = row.number("force_r_n")};
    });
    for (std::size_t i = 1; rows && i < rows->size(); ++i) {
        const TrajectoryRow &before = (*rows)[i - 1], &row = (*rows)[i];
        if (row.algorithm != before.algorithm || row.time_s > before.time_s) continue;
        return fail_at_row<std::vector<TrajectoryRow>>(
            file, i,
            fmt::format("time_s: expected more than {}, found {}", before.time_s, row.time_s));
    }
    return rows;
}

base::Result<std::vector<QosRow>> read_qos(const File& file)
{
    return rows_of<QosRow>(file, [](Row& row) {
        return QosRow{.algorithm = row.text("algorithm"),
                      .task = row.text("task"),
                      .delay_ms = row.number("delay_ms"),
                      .jitter_ms = row.number("jitter_ms"),
                      .loss_percent = row.number("loss_percent"),
                      .judged = judged_of(row)};
    });
}

base::Result<std::vector<RealTimeRow>> read_real_time(const File& file)
{
    return rows_of<RealTimeRow>(file, [](Row& row) {
        return RealTimeRow{.algorithm = row.text("algorithm"),
                           .where = row.text("where"),
                           .mean_mm = row.number_if_any("mean_mm"),
                           .std_mm = row.number_if_any("std_mm"),
                           .max_mm = row.number_if_any("max_mm"),
                           .virtual_mean_mm = row.number_if_any("virtual_mean_mm"),
                           .virtual_std_mm = row.number_if_any("virtual_std_mm"),
                           .virtual_max_mm = row.number_if_any("virtual_max_mm"),
                           .is_valid = row.flag("valid"),
                           .invalid_because = row.text("invalid_because")};
    });
}

base::Result<Replay> read_replay(const File& file)
{
    const auto rows = rows_of<ReplayRow>(file, replay_row);
    if (!rows) return tl::unexpected{rows.error()};
    if (rows->size() < 2)
        return fail_at_row<Replay>(file, rows->size(), "expected two rows at least");
    std::string_view name = file.path;
    name.remove_prefix(name.rfind('/') + 1);
    name.remove_suffix(std::min(name.size(), std::string_view{".csv"}.size()));
    const auto dash = std::min(name.rfind('-'), name.size());
    Replay replay{.algorithm = std::string{name.substr(0, dash)},
                  .task = std::string{name.substr(std::min(dash + 1, name.size()))},
                  .start_s = rows->front().time_s};
    const auto steps = static_cast<double>(rows->size() - 1);
    replay.step_s = (rows->back().time_s - replay.start_s) / steps;
    for (std::size_t i = 0; i < rows->size(); ++i) {
        const ReplayRow& row = (*rows)[i];
        const double expected = replay.start_s + static_cast<double>(i) * replay.step_s;
        if (!(replay.step_s > 0.0) || std::abs(row.time_s - expected) > 0.5 * replay.step_s) {
            return fail_at_row<Replay>(file, i,
                                       fmt::format("time_s: expected equal steps and so {:.4f}, "
                                                   "found {:.4f}",
                                                   expected, row.time_s));
        }
        for (std::size_t column = 0; column < replay_columns.size(); ++column) {
            replay.columns[column].push_back(row.values[column]);
        }
    }
    return replay;
}

} // namespace hapnet::lab::report

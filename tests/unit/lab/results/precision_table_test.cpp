// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/precision_table.hpp"

#include "lab/experiment/text.hpp"
#include "tests/unit/lab/experiment/known_law.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::lab::results::precision_table_test {
namespace {

constexpr std::string_view of_ticks = R"(
[axis]
key = "tick"
values = ["4ms", "2ms", "1ms", "0.5ms"]
reference = "0.5ms"
)";

constexpr std::string_view table = R"(
kind = "table1"
seeds = 8
algorithms = "base"
tasks = "T1"
both.delay = "80ms"
)";

constexpr std::string_view limits = R"(
kind = "limits"
seeds = 8
algorithms = "base"
tasks = "T1"
[limit.delay]
to = "200ms"
step = "50ms"
resolution = "1ms"
)";

double tick_ms(const experiment::SessionSpec& spec)
{
    return 1e3 * base::to_seconds(spec.setting.tick);
}

/// The table of an experiment whose sessions follow a law.
Table table_of_law(std::string_view kind, const experiment::PlaySession& play)
{
    const std::string text = std::string{kind} + std::string{of_ticks};
    const auto whole = experiment::parse_experiment(text, "test.toml");
    EXPECT_TRUE(whole) << whole.error().message;
    const auto points = experiment::load_axis_points(
        "test.toml", [&](const std::string&) { return base::Result<std::string>{text}; }, {});
    EXPECT_TRUE(points) << points.error().message;
    std::vector<AxisFindings> findings;
    for (const experiment::AxisPoint& point : *points) {
        AxisFindings& one = findings.emplace_back();
        one.value = point.values.front();
        one.experiment = &point.experiment;
        for (const experiment::Job& job : make_jobs(point.experiment)) {
            one.results.push_back(
                *run_job(job, point.experiment, experiment::known_criteria(), play));
        }
    }
    return precision_table(whole->axes.front(), findings, experiment::known_criteria());
}

/// The row of T1.
std::optional<TableRow> row_of(const Table& found, std::string_view figure, std::string_view value,
                               std::uint32_t seeds)
{
    for (const TableRow& row : rows_of(found)) {
        if (row.text("figure") == figure && row.text("value") == value &&
            row.number("seeds") == seeds && row.text("task") == "T1")
            return row;
    }
    return std::nullopt;
}

TEST(PrecisionTable, AreTheErrorOfTheTickAndThatOfTheSeedsTogether)
{
    // 10 mm, plus 2 mm for every millisecond of tick, plus or minus 1 mm by seed.
    const auto found = table_of_law(table, [](const experiment::SessionSpec& spec) {
        experiment::PlayedSession played = experiment::known_session(spec);
        const double swing = spec.setting.seed.value() % 2 == 0 ? 1e-3 : -1e-3;
        played.metrics.discrepancy_m->mean = 10e-3 + 2e-3 * tick_ms(spec) + swing;
        return base::Result<experiment::PlayedSession>{played};
    });
    for (const double tick : {4.0, 2.0, 1.0}) {
        const auto value = fmt::format("{:g}ms", tick);
        for (const std::uint32_t seeds : {1U, 2U, 5U, 8U}) {
            const auto row = row_of(found, "mean_mm", value, seeds);
            ASSERT_TRUE(row) << value << " " << seeds;
            EXPECT_NEAR(*row->number("found"), 10.0 + 2.0 * tick, 1e-9);
            EXPECT_NEAR(*row->number("difference"), 2.0 * (tick - 0.5), 1e-9);
            EXPECT_NEAR(*row->number("ci_low"), *row->number("difference"), 1e-9)
                << "paired: all seeds alike";
            EXPECT_NEAR(*row->number("ci_high"), *row->number("difference"), 1e-9);
            const double due = std::hypot(*row->number("difference"), 1.0 / std::sqrt(seeds));
            EXPECT_NEAR(*row->number("error"), due, 0.07) << value << " " << seeds;
            // Two players, and as many sessions on perfect networks.
            EXPECT_EQ(row->number("ticks"), 4.0 * seeds * 30e3 / tick);
        }
    }
    const auto reference = row_of(found, "mean_mm", "0.5ms", 8);
    ASSERT_TRUE(reference);
    EXPECT_EQ(*reference->number("difference"), 0.0);
    EXPECT_FALSE(row_of(found, "stiffness_ratio", "1ms", 8)) << "T1 has none";
    EXPECT_NEAR(*reference->number("order"), 1.0, 0.01) << "errors are as long as the tick";
    const Rows rows = rows_of(found);
    const auto of_p1 =
        std::ranges::find_if(rows, [](const TableRow& row) { return row.text("task") == "P1"; });
    ASSERT_NE(of_p1, rows.end());
    EXPECT_EQ(of_p1->number("seeds"), 1.0) << "nothing is drawn by lot";
    EXPECT_FALSE(of_p1->number("ci_low"));
}

TEST(PrecisionTable, OfALimitAreItsShiftWithTheTick)
{
    // The law fails from about 92 ms on. Here a tick of h adds 5 h of delay.
    const auto found = table_of_law(limits, [](const experiment::SessionSpec& spec) {
        experiment::PlayedSession played = experiment::known_session(spec);
        if (delay_ms(spec) > 0.0)
            played.metrics.body_vibration_m[0]->first += 9.99e-6 * 5.0 * tick_ms(spec);
        return base::Result<experiment::PlayedSession>{played};
    });
    for (const double tick : {4.0, 2.0, 1.0}) {
        const auto row = row_of(found, "p50 of delay, ms", fmt::format("{:g}ms", tick), 8);
        ASSERT_TRUE(row);
        EXPECT_NEAR(*row->number("difference"), -5.0 * (tick - 0.5), 1.0)
            << "levels are 1 ms apart";
        EXPECT_LT(*row->number("ci_low"), *row->number("difference") + 1e-9);
        EXPECT_GT(*row->number("ci_high"), *row->number("difference") - 1e-9);
    }
    const auto few = row_of(found, "p50 of delay, ms", "0.5ms", 1);
    const auto all = row_of(found, "p50 of delay, ms", "0.5ms", 8);
    ASSERT_TRUE(few && all);
    EXPECT_GT(*few->number("error"), *all->number("error"));
}

} // namespace
} // namespace hapnet::lab::results::precision_table_test

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/precision_rows.hpp"

#include "lab/experiment/text.hpp"
#include "tests/unit/lab/experiment/known_law.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::lab::results::precision_rows_test {
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

/// The rows of an experiment whose sessions follow a law.
std::vector<PrecisionRow> rows_of(std::string_view kind, const experiment::PlaySession& play)
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
    return make_precision_rows(whole->axes.front(), findings, experiment::known_criteria());
}

const PrecisionRow* row_of(const std::vector<PrecisionRow>& rows, std::string_view figure,
                           std::string_view value, std::uint32_t seeds)
{
    const auto found = std::ranges::find_if(rows, [&](const PrecisionRow& row) {
        return row.figure == figure && row.value == value && row.seeds == seeds && row.task == "T1";
    });
    return found == rows.end() ? nullptr : &*found;
}

TEST(PrecisionRows, AreTheErrorOfTheTickAndThatOfTheSeedsTogether)
{
    // 10 mm, 2 mm more for every millisecond of tick, and 1 mm more or less by seed.
    const auto rows = rows_of(table, [](const experiment::SessionSpec& spec) {
        experiment::PlayedSession played = experiment::known_session(spec);
        const double swing = spec.setting.seed.value() % 2 == 0 ? 1e-3 : -1e-3;
        played.metrics.discrepancy_m->mean = 10e-3 + 2e-3 * tick_ms(spec) + swing;
        return base::Result<experiment::PlayedSession>{played};
    });
    for (const double tick : {4.0, 2.0, 1.0}) {
        const auto value = fmt::format("{:g}ms", tick);
        for (const std::uint32_t seeds : {1U, 2U, 5U, 8U}) {
            const auto* row = row_of(rows, "mean_mm", value, seeds);
            ASSERT_NE(row, nullptr) << value << " " << seeds;
            EXPECT_NEAR(row->found, 10.0 + 2.0 * tick, 1e-9);
            EXPECT_NEAR(row->difference, 2.0 * (tick - 0.5), 1e-9);
            EXPECT_NEAR(*row->ci_low, row->difference, 1e-9) << "paired: all seeds alike";
            EXPECT_NEAR(*row->ci_high, row->difference, 1e-9);
            const double due = std::hypot(row->difference, 1.0 / std::sqrt(seeds));
            EXPECT_NEAR(*row->error, due, 0.07) << value << " " << seeds;
            // Two players, and as many sessions on perfect networks.
            EXPECT_EQ(row->ticks, static_cast<std::uint64_t>(4.0 * seeds * 30e3 / tick));
        }
    }
    const auto* reference = row_of(rows, "mean_mm", "0.5ms", 8);
    ASSERT_NE(reference, nullptr);
    EXPECT_EQ(reference->difference, 0.0);
    EXPECT_EQ(row_of(rows, "stiffness_ratio", "1ms", 8), nullptr) << "T1 has none";
    const auto of_p1 = std::ranges::find(rows, "P1", &PrecisionRow::task);
    ASSERT_NE(of_p1, rows.end());
    EXPECT_EQ(of_p1->seeds, 1U) << "nothing is drawn by lot";
    EXPECT_FALSE(of_p1->ci_low);
}

TEST(PrecisionRows, OfALimitAreItsShiftWithTheTick)
{
    // The law fails from about 92 ms on; here a tick of h puts 5 h of delay on top.
    const auto rows = rows_of(limits, [](const experiment::SessionSpec& spec) {
        experiment::PlayedSession played = experiment::known_session(spec);
        if (delay_ms(spec) > 0.0)
            played.metrics.body_vibration_m[0]->first += 9.99e-6 * 5.0 * tick_ms(spec);
        return base::Result<experiment::PlayedSession>{played};
    });
    for (const double tick : {4.0, 2.0, 1.0}) {
        const auto* row = row_of(rows, "p50 of delay, ms", fmt::format("{:g}ms", tick), 8);
        ASSERT_NE(row, nullptr);
        EXPECT_NEAR(row->difference, -5.0 * (tick - 0.5), 1.0) << "levels are 1 ms apart";
        EXPECT_LT(*row->ci_low, row->difference + 1e-9);
        EXPECT_GT(*row->ci_high, row->difference - 1e-9);
    }
    const auto* few = row_of(rows, "p50 of delay, ms", "0.5ms", 1);
    const auto* all = row_of(rows, "p50 of delay, ms", "0.5ms", 8);
    ASSERT_TRUE(few != nullptr && all != nullptr);
    EXPECT_GT(*few->error, *all->error);
}

} // namespace
} // namespace hapnet::lab::results::precision_rows_test

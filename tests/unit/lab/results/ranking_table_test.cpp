// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/ranking_table.hpp"

#include "lab/experiment/text.hpp"
#include "lab/results/found.hpp"
#include "tests/unit/lab/experiment/known_law.hpp"
#include "tests/unit/lab/experiment/made_people.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace hapnet::lab::results::ranking_table_test {
namespace {

constexpr std::string_view text = R"(
kind = "table1"
seeds = 2
duration = "12s"
algorithms = ["base", "sep", "lag"]
tasks = "T3"
both.delay = "80ms"
[axis]
key = "hands"
values = ["nominal", "people"]
)";

/// The distance of the copies. With people the order of the last two differs, and subject 01 has
/// larger distances than 02.
double apart_m(const experiment::SessionSpec& spec)
{
    const bool is_recorded = spec.setting.players[0].way != nullptr;
    const double order = spec.algorithm == "base"                   ? 1.0
                         : (spec.algorithm == "sep") != is_recorded ? 2.0
                                                                    : 3.0;
    if (!is_recorded) return 1e-3 * order;
    const double end_s = spec.setting.players[0].way->back().time_s;
    return 1e-3 * (order + (end_s < 8.0 ? 0.2 * end_s : 0.0)); // 0.8, 1.0 and 0
}

base::Result<experiment::PlayedSession> play(const experiment::SessionSpec& spec)
{
    auto played = experiment::known_session(spec);
    const double apart = apart_m(spec);
    played.metrics.discrepancy_m = metrics::Spread{apart, apart, apart, 0.0};
    return played;
}

struct Played {
    std::vector<experiment::AxisPoint> points;
    std::vector<AxisFindings> findings;
    experiment::Experiment whole;
};

Played played()
{
    const auto open =
        [people = experiment::open_people()](const std::string& name) -> base::Result<std::string> {
        return name == "test.toml" ? base::Result<std::string>{std::string{text}} : people(name);
    };
    Played all{*experiment::load_axis_points("test.toml", open, {}), {}, {}};
    all.whole = *experiment::load_experiment("test.toml", open, {});
    for (const experiment::AxisPoint& point : all.points) {
        AxisFindings at{point.values.front(), &point.experiment, {}};
        for (const experiment::Job& job : make_jobs(point.experiment))
            at.results.push_back(
                *run_job(job, point.experiment, experiment::known_criteria(), play));
        all.findings.push_back(std::move(at));
    }
    return all;
}

} // namespace

TEST(Rankings, CompareTheOrdersOfTheAlgorithms)
{
    const Played all = played();
    const auto table =
        ranking_table(all.whole.axes.front(), all.findings, experiment::known_criteria());
    std::vector<TableRow> rows;
    for (const TableRow& row : rows_of(table))
        if (row.text("task") == "T3") rows.push_back(row);
    ASSERT_EQ(rows.size(), 6U);
    EXPECT_EQ(rows[1].text("algorithm"), "sep");
    EXPECT_EQ(rows[1].text("rank"), "2");
    EXPECT_EQ(rows[1].text("subjects"), "0");
    EXPECT_EQ(rows[0].number("kendall_tau"), 1.0); // of an order with itself
    EXPECT_EQ(rows[4].text("rank"), "3");
    EXPECT_EQ(rows[4].text("subjects"), "2");
    EXPECT_EQ(rows[4].text("sessions"), "6");
    EXPECT_NEAR(*rows[4].number("kendall_tau"), 1.0 / 3.0, 1e-12); // one pair of three swapped
    // Between subjects: ((0.8 + 1.0) / 2 + 0) / 2 more.
    EXPECT_NEAR(*rows[3].number("mean_mm"), 1.45, 1e-9);
    EXPECT_EQ(rows[4].text("ci_low"), ""); // of two subjects
}

TEST(Results, OfRecordedHandsAreBetweenSubjects)
{
    const Played all = played();
    const auto found = find_results(*all.findings[1].experiment, experiment::known_criteria(),
                                    all.findings[1].results);
    const auto named = [&](std::string_view name) {
        const auto table = std::ranges::find(found->tables, name, &Table::name);
        return rows_of(*table);
    };
    const TableRow base = named("tasks").front();
    EXPECT_EQ(base.text("seeds"), "6");
    EXPECT_EQ(base.text("subjects"), "2");
    EXPECT_EQ(base.text("trials"), "3");
    EXPECT_NEAR(*base.number("mean_mm"), 1.45, 1e-9);
    EXPECT_NEAR(*base.number("ci_low_mm"), 1.0, 1e-9); // fewer than six: the least and the most
    EXPECT_NEAR(*base.number("ci_high_mm"), 1.9, 1e-9);
    const auto sessions = named("sessions");
    EXPECT_EQ(sessions.back().text("subject"), "02");
    EXPECT_EQ(sessions.back().text("trial"), "a");
    EXPECT_EQ(sessions.back().text("hands"), "people");
    std::vector<TableRow> paired;
    for (const TableRow& row : named("paired"))
        if (row.text("task") == "T3" && row.text("measure") == "mean_mm") paired.push_back(row);
    ASSERT_EQ(paired.size(), 2U);
    EXPECT_EQ(paired[0].text("seeds"), "2"); // subjects
    EXPECT_EQ(paired[0].text("algorithm"), "sep");
    EXPECT_NEAR(*paired[0].number("difference"), 2.0, 1e-9);
}

} // namespace hapnet::lab::results::ranking_table_test

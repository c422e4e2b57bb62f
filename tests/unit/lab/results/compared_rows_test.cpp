// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/compared_rows.hpp"
#include "lab/results/session_rows.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::results {
namespace {

/// Sessions under two delays; `mean` by delay in ms and seed.
Table sessions_of(double (*mean)(int, int))
{
    std::vector<SessionRow> rows;
    for (const int delay : {0, 40}) {
        for (int seed = 1; seed <= 7; ++seed) {
            SessionRow& row = rows.emplace_back();
            row.algorithm = "base";
            row.task = "T1";
            row.delay_ms = delay;
            row.seed = static_cast<std::uint64_t>(seed);
            row.mean_mm = mean(delay, seed);
        }
    }
    return table_of("sessions", rows);
}

TableRow row_of(const Table& compared, const std::string& conditions)
{
    for (const TableRow& row : rows_of(compared)) {
        if (row.text("conditions") == conditions && row.text("measure") == "mean_mm") return row;
    }
    throw std::runtime_error{"no row " + conditions};
}

TEST(ComparedRows, PairSessionsAndSumUpTheirConditions)
{
    const auto a = sessions_of([](int delay, int seed) { return 1.0 * delay + seed; });
    const auto b = sessions_of(
        [](int delay, int seed) { return 1.0 * delay + seed + (delay == 0 ? 0.5 : -2.0); });
    const auto rows = compare_sessions({a, "a"}, {b, "b"});
    ASSERT_TRUE(rows) << rows.error().message;
    const TableRow near = row_of(*rows, "delay_ms=0");
    EXPECT_EQ(near.number("sessions"), 7.0);
    EXPECT_DOUBLE_EQ(*near.number("median_a"), 4.0);
    EXPECT_DOUBLE_EQ(*near.number("median_b"), 4.5);
    EXPECT_DOUBLE_EQ(*near.number("difference"), 0.5);
    EXPECT_DOUBLE_EQ(*near.number("ci_low"), 0.5);
    EXPECT_DOUBLE_EQ(*near.number("sign_test_p"), 2.0 / 128.0) << "seven of seven, two-sided";
    EXPECT_DOUBLE_EQ(*row_of(*rows, "delay_ms=40").number("difference"), -2.0);
    EXPECT_EQ(row_of(*rows, "all").number("sessions"), 14.0);
    EXPECT_DOUBLE_EQ(*row_of(*rows, "all").number("sign_test_p"), 1.0);
}

TEST(ComparedRows, LeaveOutWhatOneSideHasNot)
{
    const auto a = sessions_of([](int, int seed) { return 1.0 * seed; });
    auto b = a;
    b.rows.pop_back();
    const auto compared = compare_sessions({a, "a"}, {b, "b"}).value();
    EXPECT_EQ(row_of(compared, "delay_ms=40").number("sessions"), 6.0);
    b.rows.clear();
    EXPECT_EQ(compare_sessions({a, "a"}, {b, "b"}).error().message,
              "a and b have no session in common");
    const Table other{"other", {{"a"}, {"b"}}};
    EXPECT_EQ(compare_sessions({other, "x"}, {a, "a"}).error().message,
              "x: there is no column 'algorithm': compare takes the sessions of two folders of "
              "results");
    auto twice = a;
    twice.rows.push_back(a.rows.front());
    EXPECT_TRUE(
        compare_sessions({twice, "a"}, {a, "a"}).error().message.starts_with("a: 'base,T1"));
}

TEST(ComparedRows, MeasureByColumnsThatSessionsHave)
{
    SessionRow row;
    row.mean_mm = row.std_mm = row.max_mm = row.vibration_mm = row.stiffness_ratio = 1.0;
    row.force_vibration_n = row.force_discrepancy = row.contact_lost = row.force_step_n = 1.0;
    row.drag_n = row.energy_mj = row.force_above_2hz_n = 1.0;
    const Table one = table_of("sessions", std::vector{row});
    const auto rows = compare_sessions({one, "a"}, {one, "b"}).value();
    EXPECT_EQ(rows.rows.size(), 13U);
}

} // namespace
} // namespace hapnet::lab::results

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/compared_rows.hpp"
#include "lab/results/session_rows.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::results {
namespace {

/// Sessions under two delays; `mean` by delay in ms and seed.
File sessions_of(const std::string& path, double (*mean)(int, int))
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
    return {path, base::csv_text(rows)};
}

const ComparedRow& row_of(const std::vector<ComparedRow>& rows, const std::string& conditions,
                          const std::string& measure = "mean_mm")
{
    for (const ComparedRow& row : rows) {
        if (row.conditions == conditions && row.measure == measure) return row;
    }
    throw std::runtime_error{"no row " + conditions};
}

TEST(ComparedRows, PairSessionsAndSumUpTheirConditions)
{
    const auto a = sessions_of("a.csv", [](int delay, int seed) { return 1.0 * delay + seed; });
    const auto b = sessions_of("b.csv", [](int delay, int seed) {
        return 1.0 * delay + seed + (delay == 0 ? 0.5 : -2.0);
    });
    const auto rows = compare_sessions(a, b);
    ASSERT_TRUE(rows) << rows.error().message;
    const ComparedRow& near = row_of(*rows, "delay_ms=0");
    EXPECT_EQ(near.sessions, 7U);
    EXPECT_DOUBLE_EQ(near.median_a, 4.0);
    EXPECT_DOUBLE_EQ(near.median_b, 4.5);
    EXPECT_DOUBLE_EQ(near.difference, 0.5);
    EXPECT_DOUBLE_EQ(near.ci_low, 0.5);
    EXPECT_DOUBLE_EQ(near.sign_test_p, 2.0 / 128.0) << "seven of seven, two-sided";
    EXPECT_DOUBLE_EQ(row_of(*rows, "delay_ms=40").difference, -2.0);
    EXPECT_EQ(row_of(*rows, "all").sessions, 14U);
    EXPECT_DOUBLE_EQ(row_of(*rows, "all").sign_test_p, 1.0);
}

TEST(ComparedRows, LeaveOutWhatOneSideHasNot)
{
    const auto a = sessions_of("a.csv", [](int, int seed) { return 1.0 * seed; });
    auto b = a;
    b.text.resize(b.text.rfind('\n', b.text.size() - 2) + 1);
    EXPECT_EQ(row_of(compare_sessions(a, b).value(), "delay_ms=40").sessions, 6U);
    b.text.resize(b.text.find('\n') + 1);
    const auto none = compare_sessions(a, b);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().message, "a.csv and a.csv have no session in common");
    EXPECT_EQ(compare_sessions({"x.csv", "a,b\n"}, a).error().message.find("x.csv:1: "), 0U);
    const auto row = a.text.substr(a.text.find('\n') + 1);
    const auto twice = compare_sessions({"a.csv", a.text + row}, a);
    EXPECT_EQ(twice.error().message, "a.csv:16: the session is there already");
}

TEST(ComparedRows, MeasureByColumnsThatSessionsHave)
{
    const auto header = base::csv_header<SessionRow>();
    SessionRow row;
    row.mean_mm = row.std_mm = row.max_mm = row.vibration_mm = row.stiffness_ratio = 1.0;
    row.force_vibration_n = row.force_discrepancy = row.contact_lost = row.force_step_n = 1.0;
    row.drag_n = row.energy_mj = row.force_above_2hz_n = 1.0;
    const File one{"a.csv", base::csv_text(std::vector{row})};
    const auto rows = compare_sessions(one, one).value();
    EXPECT_EQ(rows.size(), 13U) << header;
}

} // namespace
} // namespace hapnet::lab::results

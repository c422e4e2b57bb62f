// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/claim_tables.hpp"

#include "lab/results/table_text.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <string>

namespace hapnet::lab::results::claim_tables_test {
namespace {

using device::Task;

constexpr std::uint32_t first_seed = 7;

experiment::Experiment claims_of(std::uint32_t seeds, std::uint32_t needed = 200)
{
    experiment::Experiment experiment;
    experiment.kind = experiment::Claims{.judging_seeds = needed};
    experiment.seeds = seeds;
    experiment.first_seed = first_seed;
    experiment.algorithms = {{"remote-proxy", peer::algorithm_named("remote-proxy").value()}};
    return experiment;
}

/// Every session of the claims, as good as possible.
ClaimSessions perfect(const experiment::Experiment& experiment)
{
    ClaimSessions all;
    for (const experiment::ClaimCell& cell : experiment::claim_cells()) {
        for (const Task task : cell.tasks) {
            for (std::uint32_t seed = 0; seed < experiment.seeds; ++seed) {
                metrics::Scores scores{.task = task, .scored_share = 1.0};
                scores.vibration_m = metrics::ByOrder{};
                scores.force_vibration_added_n = metrics::ByOrder{};
                scores.stiffness_ratio[metrics::judged_press] = 1.0;
                scores.discrepancy_m = metrics::Spread{.mean = 1e-4};
                scores.contact_lost = 0.0;
                scores.energy_taken_j = 0.0;
                all.sessions.push_back({&cell, "remote-proxy", task, first_seed + seed, scores});
            }
        }
    }
    all.silence_m.assign(experiment.seeds, 1e-6);
    return all;
}

/// The cells of a claim, in the table claims or claims_quantiles.
struct Claimed {
    std::string value;
    std::string accept;
    std::string verdict;
    std::string quantile;
};
Claimed row_of(const experiment::Experiment& experiment, const ClaimSessions& sessions,
               std::string_view claim)
{
    Claimed found;
    for (const Table& table : claim_tables(experiment, metrics::Criteria{}, sessions)) {
        for (const TableRow& row : rows_of(table)) {
            if (row.text("claim") != claim) continue;
            if (table.name == "claims")
                found = {row.text("value"), row.text("accept"), row.text("verdict"), ""};
            else if (table.name == "claims_quantiles")
                found.quantile = row.text("quantile");
        }
    }
    return found;
}

metrics::Scores& scores_in(ClaimSessions& sessions, std::string_view cell, Task task,
                           std::uint32_t seed)
{
    const auto found = std::ranges::find_if(sessions.sessions, [&](const ClaimSession& one) {
        return one.cell->name == cell && one.task == task && one.seed == seed;
    });
    return found->scores;
}

TEST(ClaimTables, AreAllMetByPerfectSessions)
{
    const auto experiment = claims_of(40);
    const auto tables = claim_tables(experiment, metrics::Criteria{}, perfect(experiment));
    const Rows rows = rows_of(tables[0]), of_all = rows_of(tables[1]);
    EXPECT_EQ(rows.size(), 15U);
    for (const TableRow& row : rows) EXPECT_EQ(row.text("verdict"), "met") << row.text("claim");
    ASSERT_EQ(of_all.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(of_all[i].text("claim"), rows[i].text("claim"));
        EXPECT_EQ(of_all[i].number("seeds"), 40.0);
    }
    const std::string csv = csv_text(tables[0]);
    EXPECT_EQ(csv.substr(0, csv.find('\n')), "claim,value,accept,verdict")
        << "others read these columns";
}

std::map<std::string, TableRow> numbers_in(const Table& table)
{
    std::map<std::string, TableRow> rows;
    for (const TableRow& row : rows_of(table)) rows.emplace(row.text("claim"), row);
    return rows;
}

TEST(ClaimTables, HaveEachNumberWithItsIntervalAndWithHowManySeedsAClaimNeeds)
{
    const auto experiment = claims_of(100);
    ClaimSessions sessions = perfect(experiment);
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        scores_in(sessions, "300ms", Task::t2, first_seed + seed)
            .stiffness_ratio[metrics::judged_press] = 0.5 + 0.01 * seed;
    }
    const auto tables = claim_tables(experiment, metrics::Criteria{}, sessions);
    ASSERT_EQ(tables[2].name, "claims_numbers");
    const auto rows = numbers_in(tables[2]);
    const TableRow& quantile = rows.at("stiffness at 1 Hz at 300 ms");
    EXPECT_DOUBLE_EQ(*quantile.number("value"), 0.59) << "the tenth of a hundred";
    // By a binomial law with 100 and 0.1: at most 4 with 2.4 %, at least 17 with 2.1 %.
    EXPECT_DOUBLE_EQ(*quantile.number("low"), 0.54);
    EXPECT_DOUBLE_EQ(*quantile.number("high"), 0.66);
    EXPECT_EQ(quantile.number("accept_low"), 0.6);
    EXPECT_FALSE(quantile.number("accept_high"));
    EXPECT_EQ(quantile.text("judged_by"), "quantile");
    EXPECT_EQ(quantile.text("kept"), "") << "the interval lies across the bound";
    EXPECT_EQ(quantile.number("seeds"), 100.0);
    EXPECT_EQ(quantile.number("seeds_needed"), 200.0);
    const TableRow& mean = rows.at("mean discrepancy at 160 ms");
    EXPECT_EQ(mean.text("judged_by"), "mean");
    EXPECT_EQ(mean.text("unit"), "mm");
    EXPECT_EQ(mean.text("kept"), "true");
    EXPECT_EQ(rows.at("energy of all hands above its bound, by").text("judged_by"), "worst");
}

TEST(ClaimTables, AreJudgedByWhatNineOfTenSessionsKeep)
{
    constexpr std::string_view claim = "stiffness at 1 Hz at 300 ms";
    const auto experiment = claims_of(100);
    ClaimSessions sessions = perfect(experiment);
    const auto spoil = [&](std::uint32_t count) {
        for (std::uint32_t seed = 0; seed < count; ++seed) {
            scores_in(sessions, "300ms", Task::t2, first_seed + seed)
                .stiffness_ratio[metrics::judged_press] = 0.1;
        }
        return row_of(experiment, sessions, claim);
    };
    const Claimed few = spoil(4); // a heavy tail does not decide the claim
    EXPECT_EQ(few.verdict, "met");
    EXPECT_EQ(few.value, "1");
    EXPECT_EQ(few.accept, ">= 0.6");
    EXPECT_EQ(spoil(10).verdict, "undecided");
    EXPECT_EQ(spoil(17).verdict, "missed");
    EXPECT_EQ(spoil(17).value, "0.1");
    EXPECT_EQ(spoil(17).quantile, "0.1");
}

TEST(ClaimTables, AreUndecidedByTooFewSeedsForAQuantile)
{
    const auto experiment = claims_of(10);
    EXPECT_EQ(row_of(experiment, perfect(experiment), "stiffness at 1 Hz at 300 ms").verdict,
              "undecided");
}

TEST(ClaimTables, OfAMeanMayHaveOneSeedBeyondIt)
{
    constexpr std::string_view claim = "mean discrepancy of T3 at 200 and 300 ms";
    const auto experiment = claims_of(40);
    ClaimSessions sessions = perfect(experiment);
    const auto mean_of = [&](std::uint32_t seed) -> double& {
        return scores_in(sessions, "200ms", Task::t3, first_seed + seed).discrepancy_m->mean;
    };
    mean_of(0) = 20e-3;
    EXPECT_EQ(row_of(experiment, sessions, claim).verdict, "met"); // 0.6 mm
    for (std::uint32_t seed = 0; seed < 40; ++seed) mean_of(seed) = seed % 2 == 0 ? 3e-3 : 4e-3;
    EXPECT_EQ(row_of(experiment, sessions, claim).verdict, "undecided"); // the bound itself
    for (std::uint32_t seed = 0; seed < 40; ++seed) mean_of(seed) = 3.6e-3;
    EXPECT_EQ(row_of(experiment, sessions, claim).verdict, "missed");
}

TEST(ClaimTables, HoldAStiffnessAgainstTheMedianOfWhatIsDueAndNotAgainstOneSession)
{
    const auto experiment = claims_of(3);
    constexpr std::array due{98.0, 200.0, 210.0};
    std::vector<experiment::JobResult> results;
    for (const experiment::ClaimCell& cell : experiment::claim_cells()) {
        for (const Task task : cell.tasks) {
            for (const double stiffness : due) {
                experiment::SessionResult one;
                one.metrics.task = one.reference.task = task;
                one.metrics.stiffness_n_per_m[metrics::judged_press] = {150.0, 170.0};
                one.reference.stiffness_n_per_m[metrics::judged_press] = {stiffness, stiffness};
                results.emplace_back(one);
            }
        }
    }
    results.resize(results.size() + due.size(), experiment::SilenceResult{});
    for (const ClaimSession& session : claim_sessions_of(experiment, results).sessions)
        EXPECT_EQ(session.scores.stiffness_ratio[metrics::judged_press], 0.8);
}

TEST(ClaimTables, AreUndecidedWhereNothingWasMeasured)
{
    const auto experiment = claims_of(1);
    ClaimSessions sessions = perfect(experiment);
    scores_in(sessions, "300ms", Task::t2, first_seed)
        .stiffness_ratio[metrics::judged_press]
        .reset();
    const Claimed row = row_of(experiment, sessions, "stiffness at 1 Hz at 300 ms");
    EXPECT_EQ(row.verdict, "undecided");
    EXPECT_EQ(row.value, "not measured");
}

TEST(ClaimTables, CountAnUnusableSession)
{
    const auto experiment = claims_of(40);
    ClaimSessions sessions = perfect(experiment);
    for (std::uint32_t seed = 0; seed < 30; ++seed)
        scores_in(sessions, "burst-90", Task::t1, first_seed + seed).scored_share = 0.9;
    const Claimed row = row_of(experiment, sessions, "bears 97 % loss and bursts of 90");
    EXPECT_EQ(row.verdict, "missed");
    EXPECT_EQ(row.value, "97 %: 100 % usable; 90 of 100: 75 % usable");
    const Table table = claim_sessions_table(metrics::Criteria{}, sessions);
    EXPECT_EQ(table.rows.size(), sessions.sessions.size());
    EXPECT_EQ(
        std::ranges::count_if(rows_of(table),
                              [](const TableRow& one) { return one.text("tier") == "unusable"; }),
        30);
}

} // namespace
} // namespace hapnet::lab::results::claim_tables_test

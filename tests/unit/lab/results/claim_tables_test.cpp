// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/claim_tables.hpp"

#include "lab/results/table_text.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace hapnet::lab::results::claim_tables_test {
namespace {

using device::Task;

constexpr std::uint32_t first_seed = 7;

experiment::Experiment claims_of(std::uint32_t seeds, std::uint32_t judging)
{
    experiment::Experiment experiment;
    experiment.kind = experiment::Claims{.judging_seeds = judging};
    experiment.seeds = seeds;
    experiment.first_seed = first_seed;
    experiment.algorithms = {{"remote-proxy", peer::algorithm_named("remote-proxy").value()}};
    return experiment;
}

/// Every session of the claims, as good as can be.
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
            else
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
    const auto experiment = claims_of(4, 2);
    const auto tables = claim_tables(experiment, metrics::Criteria{}, perfect(experiment));
    const Rows rows = rows_of(tables[0]), of_all = rows_of(tables[1]);
    EXPECT_EQ(rows.size(), 15U);
    for (const TableRow& row : rows) EXPECT_EQ(row.text("verdict"), "met") << row.text("claim");
    ASSERT_EQ(of_all.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(of_all[i].text("claim"), rows[i].text("claim"));
        EXPECT_EQ(of_all[i].number("seeds"), 4.0);
    }
    const std::string csv = csv_text(tables[0]);
    EXPECT_EQ(csv.substr(0, csv.find('\n')), "claim,value,accept,verdict")
        << "others read these columns";
}

TEST(ClaimTables, AreJudgedByTheWorstOfTheSeedsThatJudgeAndByNoOther)
{
    constexpr std::string_view claim = "stiffness at 1 Hz at 300 ms";
    const auto experiment = claims_of(4, 2);
    ClaimSessions sessions = perfect(experiment);
    auto& beside = scores_in(sessions, "300ms", Task::t2, first_seed + 2);
    beside.stiffness_ratio[metrics::judged_press] = 0.1;
    Claimed row = row_of(experiment, sessions, claim);
    EXPECT_EQ(row.verdict, "met");
    EXPECT_EQ(row.value, "1");
    EXPECT_EQ(row.quantile, "0.1") << "a tenth of four is the least";
    auto& judging = scores_in(sessions, "300ms", Task::t2, first_seed + 1);
    judging.stiffness_ratio[metrics::judged_press] = 0.55;
    row = row_of(experiment, sessions, claim);
    EXPECT_EQ(row.verdict, "missed");
    EXPECT_EQ(row.value, "0.55");
    EXPECT_EQ(row.accept, ">= 0.6");
}

TEST(ClaimTables, OfAMeanMayHaveOneSeedBeyondIt)
{
    constexpr std::string_view claim = "mean discrepancy of T3 at 200 and 300 ms";
    const auto experiment = claims_of(2, 2);
    ClaimSessions sessions = perfect(experiment);
    scores_in(sessions, "200ms", Task::t3, first_seed).discrepancy_m->mean = 6.8e-3;
    EXPECT_EQ(row_of(experiment, sessions, claim).verdict, "met"); // 3.45 mm
    scores_in(sessions, "200ms", Task::t3, first_seed).discrepancy_m->mean = 7.0e-3;
    EXPECT_EQ(row_of(experiment, sessions, claim).verdict, "missed"); // 3.55 mm
}

TEST(ClaimTables, HoldAStiffnessAgainstTheMedianOfWhatIsDueAndNotAgainstOneSession)
{
    const auto experiment = claims_of(3, 3);
    constexpr std::array due{98.0, 200.0, 210.0};
    std::vector<experiment::JobResult> results;
    for (const experiment::ClaimCell& cell : experiment::claim_cells()) {
        for (const Task task : cell.tasks) {
            for (const double stiffness : due) {
                experiment::SessionResult one;
                one.metrics.task = one.perfect.task = task;
                one.metrics.stiffness_n_per_m[metrics::judged_press] = {150.0, 170.0};
                one.perfect.stiffness_n_per_m[metrics::judged_press] = {stiffness, stiffness};
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
    const auto experiment = claims_of(1, 1);
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
    const auto experiment = claims_of(2, 2);
    ClaimSessions sessions = perfect(experiment);
    scores_in(sessions, "burst-90", Task::t1, first_seed).scored_share = 0.9;
    const Claimed row = row_of(experiment, sessions, "bears 97 % loss and bursts of 90");
    EXPECT_EQ(row.verdict, "missed");
    EXPECT_EQ(row.value, "97 %: 100 % usable; 90 of 100: 83.3 % usable");
    const Table table = claim_sessions_table(metrics::Criteria{}, sessions);
    EXPECT_EQ(table.rows.size(), sessions.sessions.size());
    EXPECT_EQ(
        std::ranges::count_if(rows_of(table),
                              [](const TableRow& one) { return one.text("tier") == "unusable"; }),
        1);
}

} // namespace
} // namespace hapnet::lab::results::claim_tables_test

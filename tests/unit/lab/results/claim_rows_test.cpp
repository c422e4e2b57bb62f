// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/claim_rows.hpp"

#include "lab/results/table_text.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace hapnet::lab::results::claim_rows_test {
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

ClaimRow row_of(const experiment::Experiment& experiment, const ClaimSessions& sessions,
                std::string_view claim)
{
    const auto rows = make_claim_tables(experiment, metrics::Criteria{}, sessions).claims;
    const auto found = std::ranges::find(rows, claim, &ClaimRow::claim);
    return found == rows.end() ? ClaimRow{} : *found;
}

metrics::Scores& scores_in(ClaimSessions& sessions, std::string_view cell, Task task,
                           std::uint32_t seed)
{
    const auto found = std::ranges::find_if(sessions.sessions, [&](const ClaimSession& one) {
        return one.cell->name == cell && one.task == task && one.seed == seed;
    });
    return found->scores;
}

TEST(ClaimRows, AreAllMetByPerfectSessions)
{
    const auto experiment = claims_of(4, 2);
    const auto [rows, of_all] =
        make_claim_tables(experiment, metrics::Criteria{}, perfect(experiment));
    EXPECT_EQ(rows.size(), 15U);
    for (const ClaimRow& row : rows) EXPECT_EQ(row.verdict, ClaimVerdict::met) << row.claim;
    ASSERT_EQ(of_all.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(of_all[i].claim, rows[i].claim);
        EXPECT_EQ(of_all[i].seeds, 4U);
    }
    const std::string csv = csv_text(table_of("claims", rows));
    EXPECT_EQ(csv.substr(0, csv.find('\n')), "claim,value,accept,verdict")
        << "others read these columns";
}

TEST(ClaimRows, AreJudgedByTheWorstOfTheSeedsThatJudgeAndByNoOther)
{
    constexpr std::string_view claim = "stiffness at 1 Hz at 300 ms";
    const auto experiment = claims_of(4, 2);
    ClaimSessions sessions = perfect(experiment);
    auto& beside = scores_in(sessions, "300ms", Task::t2, first_seed + 2);
    beside.stiffness_ratio[metrics::judged_press] = 0.1;
    ClaimRow row = row_of(experiment, sessions, claim);
    EXPECT_EQ(row.verdict, ClaimVerdict::met);
    EXPECT_EQ(row.value, "1");
    const auto of_all = make_claim_tables(experiment, metrics::Criteria{}, sessions).quantiles;
    EXPECT_EQ(std::ranges::find(of_all, claim, &ClaimQuantileRow::claim)->quantile, "0.1")
        << "a tenth of four is the least";
    auto& judging = scores_in(sessions, "300ms", Task::t2, first_seed + 1);
    judging.stiffness_ratio[metrics::judged_press] = 0.55;
    row = row_of(experiment, sessions, claim);
    EXPECT_EQ(row.verdict, ClaimVerdict::missed);
    EXPECT_EQ(row.value, "0.55");
    EXPECT_EQ(row.accept, ">= 0.6");
}

TEST(ClaimRows, OfAMeanMayHaveOneSeedBeyondIt)
{
    constexpr std::string_view claim = "mean discrepancy of T3 at 200 and 300 ms";
    const auto experiment = claims_of(2, 2);
    ClaimSessions sessions = perfect(experiment);
    scores_in(sessions, "200ms", Task::t3, first_seed).discrepancy_m->mean = 6.8e-3;
    EXPECT_EQ(row_of(experiment, sessions, claim).verdict, ClaimVerdict::met); // 3.45 mm
    scores_in(sessions, "200ms", Task::t3, first_seed).discrepancy_m->mean = 7.0e-3;
    EXPECT_EQ(row_of(experiment, sessions, claim).verdict, ClaimVerdict::missed); // 3.55 mm
}

TEST(ClaimRows, HoldAStiffnessAgainstTheMedianOfWhatIsDueAndNotAgainstOneSession)
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

TEST(ClaimRows, AreUndecidedWhereNothingWasMeasured)
{
    const auto experiment = claims_of(1, 1);
    ClaimSessions sessions = perfect(experiment);
    scores_in(sessions, "300ms", Task::t2, first_seed)
        .stiffness_ratio[metrics::judged_press]
        .reset();
    const ClaimRow row = row_of(experiment, sessions, "stiffness at 1 Hz at 300 ms");
    EXPECT_EQ(row.verdict, ClaimVerdict::undecided);
    EXPECT_EQ(row.value, "not measured");
}

TEST(ClaimRows, CountAnUnusableSession)
{
    const auto experiment = claims_of(2, 2);
    ClaimSessions sessions = perfect(experiment);
    scores_in(sessions, "burst-90", Task::t1, first_seed).scored_share = 0.9;
    const ClaimRow row = row_of(experiment, sessions, "bears 97 % loss and bursts of 90");
    EXPECT_EQ(row.verdict, ClaimVerdict::missed);
    EXPECT_EQ(row.value, "97 %: 100 % usable; 90 of 100: 83.3 % usable");
    const auto rows = make_claim_session_rows(metrics::Criteria{}, sessions);
    EXPECT_EQ(rows.size(), sessions.sessions.size());
    EXPECT_EQ(std::ranges::count(rows, metrics::Tier::unusable, &ClaimSessionRow::tier), 1);
}

} // namespace
} // namespace hapnet::lab::results::claim_rows_test

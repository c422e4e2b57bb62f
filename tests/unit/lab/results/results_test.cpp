// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/lab/report/sample.hpp"

namespace hapnet::lab::report {
namespace {

std::string complaint(const std::vector<results::File>& files)
{
    const auto results = read_results(as_written(files));
    return results ? "" : results.error().message;
}

TEST(Results, JoinTheFilesOfSubfoldersWithBaseFirst)
{
    const auto results = read_results(as_written(whole_sample()));
    ASSERT_TRUE(results) << results.error().message;
    const auto limits = results->rows("limits"), tasks = results->rows("tasks");
    ASSERT_EQ(limits.size(), 5U);
    EXPECT_EQ(limits[2].text("algorithm"), "base");
    EXPECT_EQ(limits[2].text("impairment"), "burst-loss");
    EXPECT_EQ(results->rows("table1")[2].number("std_mm"), 4.19);
    EXPECT_EQ(tasks[0].text("limited_by"), "stiffness 0.11, not 0.77");
    EXPECT_EQ(tasks[0].number("drag_n"), std::nullopt);
    EXPECT_TRUE(results->table("none").is_empty());
    EXPECT_EQ(results->files_of("limits"),
              (std::vector<std::string>{"r/fig6a/limits.csv", "r/fig6b/limits.csv"}));
    ASSERT_EQ(results->replays.size(), 1U);
    EXPECT_EQ(results->replays[0].algorithm, "dead-reckoning");
    EXPECT_EQ(results->replays[0].task, "T3");
    EXPECT_EQ(results->replays[0].step_s, 0.01);
    ASSERT_EQ(results->replays[0].sides.size(), 2U);
    EXPECT_EQ(results->replays[0].sides[1].bodies[0][0].position.x(), 0.0);
    EXPECT_EQ(results->replays[0].sides[1].bodies[0][1].position.x(), -0.003);
    EXPECT_EQ(results->replays[0].sides[0].hand_mm[1].x, -24.0);
    EXPECT_EQ(results->replays[0].shared, std::vector<std::size_t>{0});
    EXPECT_EQ(results->runs[0].folder, "r/table1");
}

TEST(Results, NameTheFileThatIsNone)
{
    EXPECT_EQ(complaint({{"r/results.json", "{}"}}),
              "r/results.json: not what this version of hapnet-lab writes: its version is not 1");
    EXPECT_EQ(complaint({{"r/manifest.json", "[1"}}),
              "r/manifest.json:1: expected one JSON object");
}

TEST(Results, OfSeveralNumbersOfPeersAreToldApartByTheAlgorithm)
{
    results::File limits = sample_loss_limits();
    limits.text = "algorithm,impairment,task,limit,peers,scene\n"
                  "base,delay,T7,50,2,\nbase,delay,T7,20,3,carry\n";
    const auto results = read_results(as_written({limits}));
    ASSERT_TRUE(results) << results.error().message;
    const auto rows = results->rows("limits");
    EXPECT_EQ(rows[0].text("algorithm"), "base, 2 peers");
    EXPECT_EQ(rows[1].text("algorithm"), "base, 3 peers, carry");
}

TEST(Results, ShowSessionsOfTable1AndOfClaimsAndNoOthers)
{
    const auto of = [](std::string_view csv) {
        return read_results(as_written({{"r/sessions.csv", std::string{csv}}})).value();
    };
    EXPECT_EQ(of("task,network\nP1,a\nT1,a\n").rows("sessions").size(), 2U);
    EXPECT_TRUE(of("task,network\nP1,a\nT1,b\n").tables.empty()) << "of two networks";
    EXPECT_TRUE(of("task,network\nT1,a\n").tables.empty()) << "without P1";
    EXPECT_EQ(of("task,condition\nT1,a\n").rows("claim_sessions").size(), 1U);
}

TEST(Results, OfAReplayAreTwoRowsAtLeast)
{
    results::File replay = sample_replay();
    replay.text.resize(replay.text.find("0.01,1"));
    EXPECT_EQ(complaint({replay}),
              "r/table1/results.json: replay/dead-reckoning-T3: expected two rows at least");
}

TEST(Results, OfTwoFoldersMustNotContradictEachOther)
{
    results::File other = sample_table1();
    other.path = "r/table1-quick/table1.csv";
    EXPECT_EQ(complaint({sample_table1(), other}),
              "table1.csv has 'base' twice, perhaps in two folders: report one at a time");
}

TEST(Results, KnowTheCriteriaOnlyWhenAllRunsAgreeOnThem)
{
    const auto manifest = [](std::string path, std::string_view ratio) {
        return results::File{std::move(path),
                             R"({"valid": true, "criteria": "[usable]\nscored_share_min = )" +
                                 std::string{ratio} + R"("})"};
    };
    const auto one = read_results(std::vector{manifest("a/manifest.json", "0.2")});
    ASSERT_TRUE(one) << one.error().message;
    ASSERT_TRUE(one->criteria());
    EXPECT_EQ(one->criteria()->usable.scored_share_min, 0.2);
    const auto two = read_results(
        std::vector{manifest("a/manifest.json", "0.2"), manifest("b/manifest.json", "0.3")});
    ASSERT_TRUE(two);
    EXPECT_EQ(two->criteria(), std::nullopt);
    EXPECT_TRUE(complaint({manifest("a/manifest.json", "'much'")})
                    .starts_with("a/manifest.json: criteria:2:"));
}

} // namespace
} // namespace hapnet::lab::report

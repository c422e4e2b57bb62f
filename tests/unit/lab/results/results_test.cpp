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

results::File changed(results::File file, std::string_view from, std::string_view to)
{
    const auto at = file.text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    file.text.replace(at, from.size(), to);
    return file;
}

TEST(Results, JoinTheFilesOfSubfoldersWithBaseFirst)
{
    const auto results = read_results(as_written(whole_sample()));
    ASSERT_TRUE(results) << results.error().message;
    EXPECT_EQ(results->limits.size(), 5U);
    EXPECT_EQ(results->limits[2].algorithm, "base");
    EXPECT_EQ(results->limits[2].impairment, "burst-loss");
    EXPECT_TRUE(results->limits[2].is_open());
    EXPECT_EQ(results->table1[2].std_mm, 4.19);
    EXPECT_EQ(results->table1[2].verdict, results::Claim::missed);
    EXPECT_EQ(results->tasks[0].limited_by, "stiffness 0.11, not 0.77");
    EXPECT_EQ(results->tasks[0].drag_n, std::nullopt);
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

TEST(Results, NameFileAndTableAndWhatIsWrong)
{
    const results::File table1 = sample_table1(), limits = sample_limits();
    EXPECT_EQ(complaint({changed(table1, "13.620", "")}),
              "r/table1/results.json: table1: mean_mm: found ''");
    EXPECT_EQ(complaint({changed(table1, "max_mm", "maximum")}),
              "r/table1/results.json: table1: max_mm: found ''");
    EXPECT_EQ(complaint({changed(limits, "145,=", "145,<")}),
              "r/fig6a/results.json: limits: bound: found '<'");
    EXPECT_EQ(complaint({changed(sample_tasks(), "usable", "fine")}),
              "r/table1/results.json: tasks: tier: found 'fine'");
    EXPECT_EQ(complaint({{"r/results.json", "{}"}}),
              "r/results.json: not what this version of hapnet-lab writes: its version is not 1");
    EXPECT_EQ(complaint({{"r/manifest.json", "[1"}}),
              "r/manifest.json:1: expected one JSON object");
}

TEST(Results, TimesMustIncreaseAndThoseOfAReplayEqually)
{
    EXPECT_EQ(complaint({changed(sample_trajectories(), "0.005", "0.000")}),
              "r/fig7/results.json: trajectories: time_s: expected more than 0, found 0");
    const results::File replay = sample_replay();
    const std::string begin = "r/table1/results.json: replay/dead-reckoning-T3: time_s: ";
    EXPECT_EQ(complaint({changed(replay, "0.01,1", "0.00,1")}),
              begin + "expected equal steps and so 0.0000, found 0.0000");
    results::File longer = replay;
    longer.text += "0.05,1,0,0,-24,0,0,-0.5,-3,0,0,25,0,0,0.5\n";
    EXPECT_EQ(complaint({longer}), begin + "expected equal steps and so 0.0250, found 0.0100");
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
                             R"({"valid": true, "criteria": "[usable]\nstiffness_ratio_min = )" +
                                 std::string{ratio} + R"("})"};
    };
    const auto one = read_results(std::vector{manifest("a/manifest.json", "0.2")});
    ASSERT_TRUE(one) << one.error().message;
    ASSERT_TRUE(one->criteria());
    EXPECT_EQ(one->criteria()->usable.stiffness_ratio_min, 0.2);
    const auto two = read_results(
        std::vector{manifest("a/manifest.json", "0.2"), manifest("b/manifest.json", "0.3")});
    ASSERT_TRUE(two);
    EXPECT_EQ(two->criteria(), std::nullopt);
    EXPECT_TRUE(complaint({manifest("a/manifest.json", "'much'")})
                    .starts_with("a/manifest.json: criteria:2:"));
}

} // namespace
} // namespace hapnet::lab::report

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// hapnet-lab run: the same bytes whenever and however it is run, also after an interruption.
#include "tests/e2e/process.hpp"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

/// A small search: a few dozen sessions of 6 s.
constexpr std::string_view small_experiment = R"(
kind = "limits"
title = "small"
duration = "6s"
seeds = 2
algorithms = ["base", "dead-reckoning"]
tasks = ["T1", "T3"]
[limit.jitter]
to = "10ms"
step = "5ms"
resolution = "2.5ms"
)";

class LabRun : public testing::Test {
protected:
    LabRun() { std::ofstream{file} << small_experiment; }

    [[nodiscard]] std::vector<std::string> words(const std::string& out,
                                                 std::vector<std::string> more = {}) const
    {
        more.insert(more.begin(), {"run", file, "--out", folder.file(out)});
        return more;
    }

    [[nodiscard]] Outcome run_into(const std::string& out, std::vector<std::string> more = {}) const
    {
        return run("hapnet-lab", words(out, std::move(more)), 60s);
    }

    [[nodiscard]] std::string result(const std::string& out, const std::string& name) const
    {
        return text_of(folder.file(out) + "/" + name);
    }

    [[nodiscard]] nlohmann::json manifest(const std::string& out) const
    {
        return nlohmann::json::parse(result(out, "manifest.json"));
    }

    void expect_same_csv(const std::string& a, const std::string& b) const
    {
        for (const char* name : {"limits.csv", "curves.csv"}) {
            EXPECT_FALSE(result(a, name).empty()) << name;
            EXPECT_EQ(result(a, name), result(b, name)) << name;
        }
    }

    TemporaryFolder folder;
    std::string file = folder.file("small.toml");
};

void expect_refused(const Outcome& outcome, const std::vector<std::string>& words)
{
    EXPECT_EQ(outcome.exit, 2) << outcome.err;
    for (const std::string& word : words) {
        EXPECT_NE(outcome.err.find(word), std::string::npos) << word << "\n" << outcome.err;
    }
}

} // namespace

TEST_F(LabRun, WritesTheSameBytesTwiceAndForAnyNumberOfJobsAndPlaysNothingAgain)
{
    const auto one = run_into("one", {"--jobs", "1"});
    ASSERT_EQ(one.exit, 0) << one.err;
    const auto two = run_into("two", {"--jobs", "2"});
    ASSERT_EQ(two.exit, 0) << two.err;
    expect_same_csv("one", "two");
    const auto first = manifest("one");
    EXPECT_EQ(first["kind"], "limits");
    EXPECT_EQ(first["valid"], true);
    EXPECT_EQ(first["seeds"], (std::vector{1, 2}));
    EXPECT_GT(first["sessions"]["played"], 10);
    EXPECT_GT(first["speed_ratio"], 1.0);

    const auto limits = result("one", "limits.csv");
    const auto again = run_into("one");
    EXPECT_EQ(again.exit, 0) << again.err;
    EXPECT_EQ(result("one", "limits.csv"), limits);
    EXPECT_EQ(manifest("one")["sessions"]["played"], 0);
    EXPECT_EQ(manifest("one")["sessions"]["reused"], first["sessions"]["played"]);
    EXPECT_NE(again.out.find("0 sessions played"), std::string::npos) << again.out;
}

TEST_F(LabRun, StopsWithinASecondOfSigintAndGoesOnFromThere)
{
    const auto whole = run_into("whole");
    ASSERT_EQ(whole.exit, 0) << whole.err;
    {
        Process stopped{"hapnet-lab", words("parts", {"--jobs", "1"})};
        const auto sessions = folder.file("parts") + "/sessions.jsonl";
        for (int i = 0; i < 500 && text_of(sessions).size() < 3000; ++i) {
            ASSERT_EQ(stopped.wait_exit(10ms), std::nullopt) << stopped.err();
        }
        stopped.signal(SIGINT);
        EXPECT_EQ(stopped.wait_exit(1s), 1);
        EXPECT_NE(stopped.err().find("the same command goes on"), std::string::npos)
            << stopped.err();
        EXPECT_EQ(manifest("parts")["valid"], false);
    }
    const auto rest = run_into("parts");
    ASSERT_EQ(rest.exit, 0) << rest.err;
    expect_same_csv("whole", "parts");
    const auto sessions = manifest("parts")["sessions"];
    EXPECT_GT(sessions["reused"], 0);
    EXPECT_EQ(sessions["played"].get<int>() + sessions["reused"].get<int>(),
              manifest("whole")["sessions"]["played"].get<int>());
}

TEST_F(LabRun, WritesTheTableOfP1WithAReplayOfEveryTask)
{
    const auto outcome = run("hapnet-lab", {"run", "table1", "--out", folder.file("t1"), "--seeds",
                                            "1", "--set", "tasks=T1", "--set", "duration=10s"});
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    const auto table = result("t1", "table1.csv");
    EXPECT_EQ(table.find("algorithm,mean_mm,min_mm,max_mm,std_mm,paper_mean_mm,paper_max_mm,"
                         "paper_std_mm,verdict\nbase,"),
              0U)
        << table;
    EXPECT_EQ(result("t1", "replay/dead-reckoning-P1.csv").find("time_s,lx,ly,lz,"), 0U);
    EXPECT_NE(result("t1", "tasks.csv").find("\nsep,T1,1,"), std::string::npos);
    EXPECT_NE(outcome.out.find("paper_mean_mm"), std::string::npos);
}

TEST_F(LabRun, NamesBadInputAndWhatWouldBeRight)
{
    const auto out = folder.file("none");
    expect_refused(run("hapnet-lab", {"run", "fig6", "--out", out}), {"'fig6'", "fig6a"});
    expect_refused(run("hapnet-lab", {"run", "fig6a"}), {"--out"});
    expect_refused(run_into("none", {"--set", "seedz=2"}), {"--set seedz=2", "'seeds'"});
    expect_refused(run_into("none", {"--seeds", "0"}), {"--seeds"});
    std::ofstream{file} << "kind = \"limits\"\ntasks = 5\n";
    expect_refused(run_into("none"), {"small.toml:2:9: "});
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST_F(LabRun, RefusesAFolderOfOtherResults)
{
    ASSERT_EQ(run_into("one", {"--seeds", "1", "--set", "tasks=T1"}).exit, 0);
    expect_refused(run("hapnet-lab", {"run", "fig7", "--out", folder.file("one")}),
                   {"another experiment, 'small'", "--out"});
    std::filesystem::remove(folder.file("one") + "/sessions.jsonl");
    expect_refused(run_into("one"), {"something else", "--out"});
}

TEST_F(LabRun, SaysThatItCannotWrite)
{
    const auto outcome = run_into("small.toml/below");
    EXPECT_EQ(outcome.exit, 3) << outcome.err;
    EXPECT_NE(outcome.err.find("small.toml"), std::string::npos) << outcome.err;
}

} // namespace hapnet::e2e

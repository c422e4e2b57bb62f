// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// hapnet-lab run writes the same bytes however it is run, also after an interruption.
#include "tests/e2e/process.hpp"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
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
        for (const char* name : {"limits.csv", "curves.csv", "sessions.csv", "paired.csv",
                                 "results.json", "sessions.json"}) {
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
    EXPECT_EQ(first["seeds"], (std::vector{1001, 1002}));
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
                         "paper_std_mm,verdict,class,max_class\nbase,"),
              0U)
        << table;
    EXPECT_EQ(result("t1", "replay/dead-reckoning-P1.csv").find("time_s,lx,ly,lz,"), 0U);
    EXPECT_NE(result("t1", "tasks.csv").find("\nsep,T1,1,"), std::string::npos);
    EXPECT_NE(outcome.out.find("paper_mean_mm"), std::string::npos);
}

TEST_F(LabRun, KeepsRecordsThatAnalyseExportAndReplayTake)
{
    std::ofstream{file} << "kind = \"trajectories\"\ntasks = \"T3\"\nduration = \"6s\"\n"
                           "algorithms = [\"base\"]\nrecord = true\nboth.delay = \"40ms\"\n"
                           "both.loss = \"10%\"\n";
    ASSERT_EQ(run_into("kept").exit, 0);
    const auto a = folder.file("kept") + "/records/base-T3/peer-1.rec";
    const auto b = folder.file("kept") + "/records/base-T3/peer-2.rec";
    EXPECT_NE(result("kept", "records/base-T3/peer-1.rec").find(R"("message_row_bytes":157)"),
              std::string::npos)
        << "rows as long as those of a peer in this scene";
    const auto analysed = run("hapnet-lab", {"analyse", a, b, "--json"});
    ASSERT_EQ(analysed.exit, 0) << analysed.err;
    const auto analysis = nlohmann::json::parse(analysed.out);
    EXPECT_EQ(analysis["valid"], true) << analysis["invalid_because"];
    EXPECT_NEAR(analysis["a_to_b"]["loss"].get<double>(), 0.1, 0.02);
    EXPECT_NEAR(analysis["a_to_b"]["delay_ms"]["p50"].get<double>(), 40.0, 0.1);
    const auto sessions = result("kept", "sessions.csv");
    const auto mean = analysis["discrepancy_x_mm"]["mean"].get<double>();
    std::istringstream lines{sessions};
    std::string head, row, cell;
    std::getline(lines, head);
    std::getline(lines, row);
    const auto column = [&](const std::string& name) {
        const auto at = head.find("," + name + ",");
        return std::count(head.begin(), head.begin() + static_cast<std::ptrdiff_t>(at) + 1, ',');
    };
    std::istringstream cells{row};
    for (auto i = column("mean_mm"); i >= 0; --i) std::getline(cells, cell, ',');
    EXPECT_NEAR(std::stod(cell), mean, 0.001) << "the row of the session says the same";
    const auto replayed = run("hapnet-lab", {"replay", a, "--json"});
    EXPECT_EQ(replayed.exit, 0) << replayed.err;
    const auto exported = run("hapnet-lab", {"export", a, b, "--csv"});
    EXPECT_EQ(exported.exit, 0) << exported.err;
    EXPECT_EQ(exported.out.find("time_s,"), 0U);
}

TEST_F(LabRun, RepeatsItselfAlongAnAxis)
{
    const auto outcome =
        run_into("axis", {"--set", "tasks=T1", "--set", "axis.key=both.delay", "--set",
                          "axis.values=[\"0ms\", \"5ms\"]", "--set", "axis.reference=0ms"});
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    const auto limits = result("axis", "limits_by_axis.csv");
    EXPECT_EQ(limits.find("parameter,value,algorithm,"), 0U) << limits;
    EXPECT_NE(limits.find("\nboth.delay,5ms,base,jitter,T1,"), std::string::npos) << limits;
    EXPECT_FALSE(result("axis", "sessions_by_axis.csv").empty());
    EXPECT_EQ(result("axis", "limits.csv"), "");
    EXPECT_EQ(result("axis", "precision.csv").find("algorithm,task,figure,parameter,value,"), 0U);
    EXPECT_NE(result("axis", "B2SUMS").find("precision.csv"), std::string::npos);
    EXPECT_GT(manifest("axis")["processor_time_s"], 0.0);
    EXPECT_EQ(run("hapnet-lab", {"report", folder.file("axis")}).exit, 0);
}

TEST_F(LabRun, DrawsALatinHypercubeAlsoInShardsOfAPlan)
{
    std::ofstream{file} << "kind = \"plane\"\nseeds = 2\nalgorithms = \"base\"\ntasks = \"T1\"\n"
                           "duration = \"6s\"\n[plane]\ndelay = \"0ms\"\njitter = \"0ms\"\n"
                           "loss = \"0%\"\n[[axis]]\nkey = \"plane.delay\"\nfrom = \"0ms\"\n"
                           "to = \"100ms\"\n[[axis]]\nkey = \"hands.stiffness\"\n"
                           "from = \"100N/m\"\nto = \"500N/m\"\n[latin_hypercube]\npoints = 5\n";
    ASSERT_EQ(run_into("drawn").exit, 0);
    const auto sessions = result("drawn", "sessions_by_point.csv");
    EXPECT_EQ(sessions.find("point,plane.delay,hands.stiffness,"), 0U) << sessions;
    EXPECT_EQ(std::count(sessions.begin(), sessions.end(), '\n'), 1 + 5 * 2) << sessions;
    EXPECT_NE(sessions.find("\n5,"), std::string::npos) << sessions;
    EXPECT_NE(result("drawn", "qos_by_point.csv"), "");
    EXPECT_EQ(result("drawn", "qos.csv"), "");
    const auto sweep = folder.file("sweep");
    ASSERT_EQ(run("hapnet-lab", {"plan", file, "--out", sweep}).exit, 0);
    for (const char* shard : {"0/3", "1/3", "2/3"})
        ASSERT_EQ(run("hapnet-lab", {"run", sweep, "--shard", shard}, 60s).exit, 0) << shard;
    ASSERT_EQ(run("hapnet-lab", {"merge", sweep}, 60s).exit, 0);
    EXPECT_EQ(manifest("sweep")["digest"], manifest("drawn")["digest"]);
    const auto compared = run("hapnet-lab", {"compare", sweep, folder.file("drawn"), "--json"});
    ASSERT_EQ(compared.exit, 0) << compared.err;
    expect_refused(run_into("none", {"--set", "axis=[{ key = \"seeds\", from = \"0\" }]"}),
                   {"axis 'seeds'"});
}

TEST_F(LabRun, PlaysOwnScenesOptionsAndRecordedHands)
{
    std::ofstream{folder.file("left.csv")} << "time_s,x_m,y_m,z_m\n0,-0.06,0,0\n2,-0.02,0,0\n";
    std::ofstream{file} << "kind = \"trajectories\"\ntasks = \"T3\"\nduration = \"6s\"\n"
                           "algorithms = [\"base\"]\nscene = \"carry\"\n"
                           "replay = [\"" +
                               folder.file("left.csv") + "\", \"\"]\n[task_options]\npace = 1.0\n";
    const auto outcome = run_into("own");
    ASSERT_EQ(outcome.exit, 0) << outcome.err;
    const auto rows = result("own", "sessions.csv");
    EXPECT_NE(rows.find(",carry,"), std::string::npos) << rows;
    std::istringstream lines{result("own", "trajectories.csv")};
    std::string line, last;
    while (std::getline(lines, line)) last = line;
    std::istringstream cells{last};
    for (int i = 0; i < 5; ++i) std::getline(cells, line, ',');
    EXPECT_NEAR(std::stod(line), -20.0, 1.0) << "the left hand stays where its file ends: " << last;
    expect_refused(run_into("none", {"--set", "replay=[\"none.csv\", \"\"]"}), {"none.csv"});
    const std::string script = "script=[\"" + folder.file("left.csv") + "\", \"\"]";
    expect_refused(run_into("none", {"--set", script}), {"either a replay or a script"});
    ASSERT_EQ(run_into("script", {"--set", script, "--set", "replay=[\"\", \"\"]"}).exit, 0);
    EXPECT_NE(result("script", "trajectories.csv"), result("own", "trajectories.csv"));
}

TEST_F(LabRun, MergesTheShardsOfAPlanIntoTheSameBytesAlsoAfterOneWasKilled)
{
    const auto lab = [](std::vector<std::string> words) { return run("hapnet-lab", words, 60s); };
    ASSERT_EQ(run_into("whole").exit, 0);
    const auto sweep = folder.file("sweep");
    ASSERT_EQ(lab({"plan", file, "--out", sweep}).exit, 0);
    std::filesystem::rename(file, folder.file("elsewhere.toml")); // the plan has all it needs
    ASSERT_EQ(lab({"run", sweep, "--shard", "0/2"}).exit, 0);
    const auto early = lab({"merge", sweep});
    EXPECT_EQ(early.exit, 1);
    EXPECT_NE(early.err.find("not all shards have begun"), std::string::npos) << early.err;
    EXPECT_FALSE(std::filesystem::exists(sweep + "/limits.csv"));
    const auto sessions = sweep + "/shards/1-of-2.jsonl";
    {
        Process killed{"hapnet-lab", {"run", sweep, "--shard", "1/2", "--jobs", "1"}};
        for (int i = 0; i < 500 && text_of(sessions).size() < 3000; ++i)
            ASSERT_EQ(killed.wait_exit(10ms), std::nullopt) << killed.err();
        killed.signal(SIGKILL);
        ASSERT_NE(killed.wait_exit(1s), std::nullopt);
    }
    const auto unfinished = lab({"merge", sweep});
    EXPECT_EQ(unfinished.exit, 1);
    EXPECT_NE(unfinished.err.find("have not ended: 1/2"), std::string::npos) << unfinished.err;
    const auto rest = lab({"run", sweep, "--shard", "1/2"});
    ASSERT_EQ(rest.exit, 0) << rest.err;
    EXPECT_EQ(rest.out.find(" 0 reused"), std::string::npos) << rest.out;
    const auto merged = lab({"merge", sweep});
    ASSERT_EQ(merged.exit, 0) << merged.err;
    expect_same_csv("whole", "sweep");
    EXPECT_EQ(result("sweep", "B2SUMS"), result("whole", "B2SUMS"));
    EXPECT_EQ(manifest("sweep")["digest"], manifest("whole")["digest"]);
    const auto compared = lab({"compare", sweep, folder.file("whole"), "--json"});
    ASSERT_EQ(compared.exit, 0) << compared.err;
    for (const auto& row : nlohmann::json::parse(compared.out)["compared"])
        EXPECT_EQ(row["difference"], 0.0) << row;
    expect_refused(lab({"run", sweep, "--shard", "0/2", "--seeds", "3"}), {"a plan says it all"});
    expect_refused(lab({"run", "fig7", "--shard", "0/2", "--out", sweep}), {"needs a plan"});
}

TEST_F(LabRun, LeavesOutALineOfAShardInWhichADigitWasChanged)
{
    const auto lab = [](std::vector<std::string> words) { return run("hapnet-lab", words, 60s); };
    const auto sweep = folder.file("sweep");
    ASSERT_EQ(lab({"plan", file, "--seeds", "1", "--out", sweep}).exit, 0);
    ASSERT_EQ(lab({"run", sweep, "--shard", "0/1"}).exit, 0);
    ASSERT_EQ(lab({"merge", sweep}).exit, 0);
    const auto digest = manifest("sweep")["digest"];
    const auto shard = sweep + "/shards/0-of-1.jsonl";
    auto sessions = text_of(shard);
    const auto at =
        sessions.find_first_of("12345678", sessions.find("\"mean\":", sessions.size() / 2));
    ++sessions[at];
    std::ofstream{shard} << sessions;
    const auto merged = lab({"merge", sweep});
    EXPECT_EQ(merged.exit, 1) << merged.out;
    const std::vector<std::string> said{"lacks the right checksum (" + shard + ":",
                                        "was not played",
                                        "run the shards with damaged lines again"};
    for (const std::string& word : said)
        EXPECT_NE(merged.err.find(word), std::string::npos) << word << "\n" << merged.err;
    const auto again = lab({"run", sweep, "--shard", "0/1"});
    ASSERT_EQ(again.exit, 0) << again.err;
    EXPECT_NE(again.out.find(" 1 sessions played"), std::string::npos) << again.out;
    ASSERT_EQ(lab({"merge", sweep}).exit, 0);
    EXPECT_EQ(manifest("sweep")["digest"], digest);
}

TEST_F(LabRun, IsNeitherReportedNorComparedOnceATableWasChanged)
{
    const auto lab = [](std::vector<std::string> words) { return run("hapnet-lab", words, 60s); };
    ASSERT_EQ(run_into("one", {"--seeds", "1", "--set", "tasks=T1"}).exit, 0);
    const auto one = folder.file("one");
    ASSERT_EQ(lab({"report", one}).exit, 0);
    ASSERT_EQ(lab({"compare", one, one}).exit, 0);
    const auto before = result("one", "sessions.csv");
    auto changed = before;
    const auto at = changed.find_last_of("12345678");
    ++changed[at];
    std::ofstream{one + "/sessions.csv"} << changed;
    for (const auto& words : {std::vector<std::string>{"report", one},
                              {"report", folder.file("")},
                              {"compare", one, one}})
        expect_refused(lab(words), {"one/sessions.csv was changed", "B2SUMS"});
    std::ofstream{one + "/sessions.csv"} << before;
    EXPECT_EQ(lab({"report", one}).exit, 0);
    std::filesystem::remove(one + "/limits.csv");
    expect_refused(lab({"report", one}), {"limits.csv is missing"});
    ASSERT_EQ(run_into("one", {"--seeds", "1", "--set", "tasks=T1"}).exit, 0);
    EXPECT_EQ(lab({"report", one}).exit, 0);
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

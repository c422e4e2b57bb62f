// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/options.hpp"

#include "tests/support/cli/help_faults.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab {
namespace {

using namespace std::chrono_literals;

std::string refusal_to(std::vector<std::string> words)
{
    return cli::refusal_of(parse_command_line, "hapnet-lab", std::move(words));
}

template <typename T>
T command_of(std::vector<std::string> words)
{
    cli::Typed typed{"hapnet-lab", std::move(words)};
    return std::get<T>(std::get<Command>(parse_command_line(typed.words()).value()));
}

TEST(LabOptions, HaveACompleteHelp)
{
    const auto prints = cli::prints_of("hapnet-lab", parse_command_line);
    EXPECT_EQ(cli::help_faults("hapnet-lab", prints), std::vector<std::string>{});
    EXPECT_EQ(
        prints({"report", "--help"})
            ->rfind("Usage: hapnet-lab report DIR|RECORD_A [RECORD_B] [MORE ...] [--out FILE]\n",
                    0),
        0U);
    EXPECT_EQ(prints({"help", "plan"})
                  ->rfind("Usage: hapnet-lab plan EXPERIMENT --out DIR [OPTIONS]\n", 0),
              0U);
}

TEST(LabOptions, HoldWhatWasTyped)
{
    const auto run = command_of<RunCommand>(
        {"run", "fig6a", "--set", "a=1", "--set", "b=2", "--seeds", "10", "--out", "dir"});
    EXPECT_EQ(run.experiment, "fig6a");
    EXPECT_EQ(run.settings, (std::vector<std::string>{"a=1", "b=2"}));
    EXPECT_EQ(run.seeds, 10U);
    EXPECT_EQ(run.out, "dir");
    EXPECT_EQ(run.command, "hapnet-lab run fig6a --set a=1 --set b=2 --seeds 10 --out dir");
    const auto explain = command_of<ExplainCommand>({"explain", "paper", "--no-sleeping"});
    EXPECT_FALSE(explain.sleeping);
    EXPECT_EQ(explain.tick, 1ms);
    EXPECT_EQ(command_of<ExportCommand>({"export", "a.rec", "--csv", "--rows", "messages"}).rows,
              ExportRows::messages);
    EXPECT_EQ(command_of<ExportCommand>({"export", "a.rec", "b.rec", "--csv"}).other, "b.rec");
    EXPECT_EQ(command_of<ReplayCommand>({"replay", "a.rec", "--algorithm", "dr"}).algorithm,
              "dead-reckoning");
}

TEST(LabOptions, UnderstandTheOtherSpellingOfAnalyse)
{
    EXPECT_EQ(command_of<AnalyseCommand>({"analyze", "a", "b"}).record_b, "b");
}

TEST(LabOptions, ReportAFolderOrTwoRecords)
{
    EXPECT_EQ(command_of<ReportCommand>({"report", "results"}).record_b, "");
    const auto report = command_of<ReportCommand>({"report", "a.rec", "b.rec"});
    EXPECT_EQ(report.path, "a.rec");
    EXPECT_EQ(report.record_b, "b.rec");
}

TEST(LabOptions, ListWhatIsBuiltIn)
{
    const auto list = cli::prints_of("hapnet-lab", parse_command_line)({"list"}).value();
    for (const char* name : {" fig6a, ", "paper\n", " rolling, ", " dead-reckoning, ", " T1, "})
        EXPECT_NE(list.find(name), std::string::npos) << name << " in\n" << list;
}

TEST(LabOptions, TakeShardsFromZeroToTheirNumberLessOne)
{
    const auto run = command_of<RunCommand>({"run", "sweep", "--shard", "3/16"});
    EXPECT_EQ(run.shard, (experiment::Shard{3, 16}));
    for (const char* bad : {"16/16", "3", "3/0", "-1/2", "1/2/3", "0/100001"}) {
        EXPECT_NE(refusal_to({"run", "sweep", "--shard", bad}).find("from 0/N to N-1/N"),
                  std::string::npos)
            << bad;
    }
    EXPECT_EQ(command_of<MergeCommand>({"merge", "a", "b", "c"}).folders,
              (std::vector<std::string>{"a", "b", "c"}));
}

TEST(LabOptions, SayWhatIsMissingOrMistyped)
{
    EXPECT_EQ(refusal_to({"analyse", "a.rec"}),
              "RECORD_B is required: hapnet-lab analyse a.rec b.rec");
    EXPECT_EQ(refusal_to({"plan", "fig6a"}), "--out is required: --out sweep");
    EXPECT_EQ(refusal_to({"run", "fig6a", "--output", "x"}),
              "unknown option --output: did you mean --out?");
    EXPECT_EQ(refusal_to({"repotr", "x"}),
              "unknown command 'repotr': did you mean hapnet-lab report?");
    EXPECT_NE(refusal_to({"explain", "paper", "--tick", "1s"}).find("10us to 100ms"),
              std::string::npos);
    EXPECT_EQ(refusal_to({"replay", "a", "--json", "--csv"}),
              "--json and --csv exclude each other: give one of them");
    EXPECT_EQ(refusal_to({}).rfind("a command is required: hapnet-lab COMMAND", 0), 0U);
}

} // namespace
} // namespace hapnet::lab

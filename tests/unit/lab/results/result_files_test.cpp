// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The files of an experiment whose sessions follow a known law.
#include "lab/experiment/text.hpp"
#include "lab/results/result_files.hpp"
#include "lab/results/results.hpp"
#include "lab/results/rows.hpp"
#include "tests/unit/lab/experiment/known_law.hpp"

#include <gtest/gtest.h>
#include <map>
#include <set>

namespace hapnet::lab::results {

namespace {

constexpr std::string_view delay_limits = R"(
kind = "limits"
title = "known"
seeds = 3
algorithms = ["base", "dead-reckoning"]
tasks = ["T1", "T3"]
[limit.delay]
to = "200ms"
step = "50ms"
resolution = "1ms"
)";

experiment::Experiment experiment_of(std::string_view text)
{
    auto experiment = experiment::parse_experiment(text, "test.toml");
    EXPECT_TRUE(experiment) << experiment.error().message;
    return *std::move(experiment);
}

/// All jobs one after another, by the known law.
std::map<std::string, std::string> results(const experiment::Experiment& experiment,
                                           const experiment::PlaySession& play)
{
    std::vector<experiment::JobResult> findings;
    for (const experiment::Job& part : make_jobs(experiment)) {
        findings.push_back(*run_job(part, experiment, experiment::known_criteria(), play));
    }
    std::map<std::string, std::string> files;
    auto written = make_result_files(experiment, experiment::known_criteria(), findings);
    for (auto& file : *written) files[file.path] = file.text;
    return files;
}

base::Result<experiment::PlayedSession> play_known(const experiment::SessionSpec& spec)
{
    return known_session(spec);
}

} // namespace

TEST(Results, LimitsAreThoseOfTheLawByTaskAndOfTheWorst)
{
    const auto files =
        results(experiment_of(delay_limits), [](const experiment::SessionSpec& spec) {
            experiment::PlayedSession played = known_session(spec);
            if (spec.setting.task == device::Task::t3) played.metrics.body_vibration_m[0].reset();
            return base::Result<experiment::PlayedSession>{played};
        });
    // 0.95 mm / (1.02 * 9.99 um) is 93.2: the third seed decides.
    EXPECT_EQ(files.at("limits.csv"),
              "algorithm,impairment,task,limit,bound,unit,paper_limit,status\n"
              "base,delay,T1,93,=,ms,160,predicted-missed\n"
              "base,delay,T3,200,>,ms,160,predicted-missed\n"
              "base,delay,worst,93,=,ms,160,predicted-missed\n"
              "dead-reckoning,delay,T1,93,=,ms,150,predicted-missed\n"
              "dead-reckoning,delay,T3,200,>,ms,150,predicted-missed\n"
              "dead-reckoning,delay,worst,93,=,ms,150,predicted-missed\n");
    EXPECT_FALSE(files.contains("limits_by_convention.csv"));
}

TEST(Results, OfSeveralNumbersOfPeersStandBesideEachOther)
{
    const auto experiment = experiment_of(R"(
kind = "limits"
title = "many"
seeds = 1
algorithms = "base"
tasks = "T7"
peers = [2, 3]
[limit.delay]
to = "50ms"
step = "50ms"
resolution = "1ms"
)");
    const auto files = results(experiment, [](const experiment::SessionSpec& spec) {
        experiment::PlayedSession played = known_session(spec);
        const bool is_far = delay_ms(spec) > 20.0;
        if (spec.setting.players.size() == 3 && is_far)
            played.metrics.body_vibration_m[0]->first = 1.0;
        return base::Result<experiment::PlayedSession>{played};
    });
    // What the paper says holds for two.
    EXPECT_EQ(files.at("limits.csv"),
              "algorithm,impairment,task,limit,bound,unit,paper_limit,status,peers\n"
              "base,delay,T7,50,>,ms,160,predicted-missed,2\n"
              "base,delay,worst,50,>,ms,160,predicted-missed,2\n"
              "base,delay,T7,20,=,ms,,,3\n"
              "base,delay,worst,20,=,ms,,,3\n");
    const std::string& curves = files.at("curves.csv");
    EXPECT_EQ(curves.substr(0, curves.find('\n')),
              "algorithm,impairment,task,level,unit,seed,mean_mm,vibration_mm,stiffness_ratio,"
              "force_vibration_n,tier,peers");
    const std::vector<File> folder{{"limits.csv", files.at("limits.csv")}, {"curves.csv", curves}};
    const auto read = read_results(folder);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->limits.front().algorithm, "base, 2 peers");
    EXPECT_EQ(read->limits.back().algorithm, "base, 3 peers");
}

TEST(Results, ACellStopsAtItsFirstFailingSeedInSeedOrder)
{
    std::set<std::pair<double, std::uint64_t>> sessions;
    const auto files =
        results(experiment_of(delay_limits), [&](const experiment::SessionSpec& spec) {
            sessions.insert({delay_ms(spec), spec.setting.seed.value()});
            return base::Result<experiment::PlayedSession>{known_session(spec)};
        });
    EXPECT_TRUE(sessions.contains({50.0, 3}));
    EXPECT_TRUE(sessions.contains({100.0, 1}));
    EXPECT_FALSE(sessions.contains({100.0, 2}));
    const std::string& curves = files.at("curves.csv");
    EXPECT_EQ(curves.substr(0, curves.find('\n')),
              "algorithm,impairment,task,level,unit,seed,mean_mm,vibration_mm,stiffness_ratio,"
              "force_vibration_n,tier");
    EXPECT_NE(curves.find("\nbase,delay,T1,50,ms,3,5.000,0.509,,,good\n"
                          "base,delay,T1,75,ms,1,7.500,0.749,,,good\n"),
              std::string::npos)
        << curves;
    EXPECT_NE(curves.find("\nbase,delay,T1,100,ms,1,10.000,0.999,,,unusable\n"
                          "base,delay,T3,0,ms,1,"),
              std::string::npos);
}

TEST(Results, OtherConventionsReuseTheSessionsAndPlayOnlyWhereTheyJudgeOtherwise)
{
    const auto experiment = experiment_of(std::string{delay_limits} + R"(
[convention]
filter_orders = [1, 2, 4]
hands = ["nominal", ["relaxed", "firm"]]
tasks = ["T1"]
seeds = 1
)");
    std::map<std::string, int> sessions;
    const auto files = results(experiment, [&](const experiment::SessionSpec& spec) {
        ++sessions[key_of(spec, "test")];
        return base::Result<experiment::PlayedSession>{known_session(spec)};
    });
    EXPECT_EQ(files.at("limits_by_convention.csv")
                  .substr(0, files.at("limits_by_convention.csv").find("dead")),
              "algorithm,impairment,task,filter_order,hand,limit,bound,unit\n"
              "base,delay,T1,1,nominal,95,=,ms\n"
              "base,delay,T1,2,nominal,190,=,ms\n"
              "base,delay,T1,4,nominal,200,>,ms\n"
              "base,delay,T1,1,relaxed/firm,95,=,ms\n"
              "base,delay,T1,2,relaxed/firm,190,=,ms\n"
              "base,delay,T1,4,relaxed/firm,200,>,ms\n");
    EXPECT_LT(sessions.size(), 150U); // that many with a store; 9 times as many searches
}

TEST(Results, Table1HasARowForEachAlgorithmAndTheTasksBesideIt)
{
    const auto files = results(experiment_of(R"(
kind = "table1"
seeds = 2
tasks = ["T1"]
both.delay = "80ms"
)"),
                               play_known);
    EXPECT_EQ(files.at("table1.csv"),
              "algorithm,mean_mm,min_mm,max_mm,std_mm,paper_mean_mm,paper_max_mm,paper_std_mm,"
              "verdict\n"
              "base,8.000,0.000,24.000,0.100,13.789,46.010,10.986,missed\n"
              "sep,8.000,0.000,24.000,0.100,13.991,50.120,10.808,met\n"
              "dead-reckoning,8.000,0.000,24.000,0.100,3.341,58.850,3.840,missed\n");
    const std::string& tasks = files.at("tasks.csv");
    EXPECT_NE(tasks.find("\nbase,T1,2,8.000,0.100,24.000,0.807,,,,,,,,good,\n"), std::string::npos)
        << tasks;
    EXPECT_EQ(tasks.find(",P1,"), std::string::npos);
    EXPECT_EQ(files.at("replay/sep-P1.csv"),
              base::csv_header<ReplayRow>() + "\n0.0000,1,2,3,4,5,6,7,8,9,10,11,12,13,14\n");
}

TEST(Results, TheOtherKindsWriteTheirColumns)
{
    const auto trajectories =
        results(experiment_of("kind = \"trajectories\"\nalgorithms = \"base\"\ntasks = \"T1\"\n"),
                play_known);
    EXPECT_EQ(trajectories.at("trajectories.csv"),
              "algorithm,time_s,cube_l_mm,cube_r_mm,hand_l_mm,hand_r_mm,force_l_n,force_r_n\n"
              "base,0.0000,1.000,8.000,4.000,11.000,7.0000,14.0000\n");
    const auto plane = results(experiment_of(R"(
kind = "plane"
algorithms = "base"
tasks = "T1"
seeds = 2
[plane]
delay = ["0ms", "100ms"]
jitter = ["0ms", "15ms"]
loss = ["50%"]
)"),
                               play_known);
    EXPECT_EQ(plane.at("qos.csv"),
              "algorithm,task,delay_ms,jitter_ms,loss_percent,mean_mm,vibration_mm,"
              "stiffness_ratio,force_vibration_n,tier\n"
              "base,T1,0,0,50,0.000,0.000,,,good\n"
              "base,T1,0,15,50,1.500,0.151,,,good\n"
              "base,T1,100,0,50,10.000,1.009,,,unusable\n"
              "base,T1,100,15,50,10.000,1.009,,,unusable\n");
}

TEST(Rows, ThinATraceToTheRowsThatAreWanted)
{
    virtual_time::Trace trace;
    trace.begin = std::chrono::milliseconds{2};
    for (auto& side : trace.sides) side.resize(25);
    trace.sides[1][10].body = base::Position{{0.0123, 0.0, -0.5}};
    const auto rows = to_lines(make_replay_rows(trace, 100));
    EXPECT_EQ(rows, "0.0020,0.000,0.000,0.000,0.000,0.000,0.000,0.0000,0.000,0.000,0.000,0.000,"
                    "0.000,0.000,0.0000\n"
                    "0.0120,0.000,0.000,0.000,0.000,0.000,0.000,0.0000,12.300,0.000,-500.000,0.000,"
                    "0.000,0.000,0.0000\n"
                    "0.0220,0.000,0.000,0.000,0.000,0.000,0.000,0.0000,0.000,0.000,0.000,0.000,"
                    "0.000,0.000,0.0000\n");
    EXPECT_TRUE(make_replay_rows(trace, 0).empty());
}

TEST(SessionKeys, TellApartAllThatASessionFollowsFrom)
{
    const auto experiment = experiment_of(delay_limits);
    const experiment::NamedAlgorithm& base = experiment.algorithms[0];
    const experiment::NamedAlgorithm& other = experiment.algorithms[1];
    std::set<std::string> keys;
    const auto add = [&](const experiment::SessionSpec& spec, std::string_view program = "this") {
        keys.insert(key_of(spec, program));
    };
    const auto spec =
        make_session_spec(experiment, {base, experiment.hands, device::Task::t1, 1}, {});
    add(spec);
    add(spec, "that");
    add(make_session_spec(experiment, {base, experiment.hands, device::Task::t3, 1}, {}));
    add(make_session_spec(experiment, {base, experiment.hands, device::Task::t1, 2}, {}));
    add(make_session_spec(experiment, {other, experiment.hands, device::Task::t1, 1}, {}));
    experiment::Hands firm = experiment.hands;
    firm.right = *device::operator_named("firm");
    add(make_session_spec(experiment, {base, firm, device::Task::t1, 1}, {}));
    add(make_session_spec(experiment, {base, experiment.hands, device::Task::t1, 1},
                          impaired({}, experiment::Impairment::delay, {1})));
    experiment::SessionSpec changed = spec;
    changed.setting.length += std::chrono::nanoseconds{1};
    add(changed);
    changed = spec;
    changed.setting.tick += std::chrono::nanoseconds{1};
    add(changed);
    changed = spec;
    changed.setting.scene.bodies[0].mass_kg *= 2.0;
    add(changed);
    changed = spec;
    changed.rows_per_s = 100;
    add(changed);
    experiment::Experiment keyed = experiment;
    keyed.keyed = true;
    const auto sealed = make_session_spec(keyed, {base, experiment.hands, device::Task::t1, 1}, {});
    EXPECT_TRUE(sealed.setting.players[0].circle && sealed.setting.players[1].circle);
    add(sealed);
    EXPECT_EQ(keys.size(), 12U);
    EXPECT_EQ(key_of(perfect_twin(spec), "this"), key_of(spec, "this"));
}

} // namespace hapnet::lab::results

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The requirements on a network, from sessions with known limits, and the classes of ITU-T Y.1541.
#include "lab/experiment/text.hpp"
#include "lab/results/found.hpp"
#include "lab/results/requirements.hpp"
#include "lab/results/table_text.hpp"
#include "tests/unit/lab/experiment/known_law.hpp"

#include <gtest/gtest.h>
#include <map>

namespace hapnet::lab::results {

namespace {

constexpr std::string_view all_factors = R"(
kind = "limits"
title = "known"
seeds = 6
first_seed = 1
algorithms = "base"
tasks = ["T1", "T2", "T3"]
tiers = ["good", "usable"]
[limit.delay]
to = "200ms"
step = "50ms"
resolution = "1ms"
[limit.jitter]
to = "40ms"
step = "10ms"
resolution = "1ms"
[limit.random-loss]
to = "90%"
step = "10%"
resolution = "1%"
[limit.burst-loss]
to = 90
step = 10
resolution = 1
[limit.interval]
to = 50
step = 10
resolution = 1
)";

/// Half of a usable session's distance is good.
metrics::Criteria criteria()
{
    auto known = experiment::known_criteria();
    known.usable.discrepancy_max_m = 10e-3;
    known.good.discrepancy_max_m = 5e-3;
    return known;
}

/// The badness of the network: 1 at 100 ms, or jitter of 10 ms, or half of all lost, or bursts of
/// 40, or one message in ten ticks.
double badness(const experiment::SessionSpec& spec)
{
    const emulator::Conditions& up = spec.setting.profile.path.up;
    double sum = (spec.setting.players[0].send.every - 1) / 9.0;
    const auto* jitter = std::get_if<emulator::UniformLaw>(&up.jitter.law);
    sum += jitter != nullptr ? 100.0 * base::to_seconds(jitter->half_width)
                             : 1e-2 * experiment::delay_ms(spec);
    for (const emulator::LossLaw& law : up.loss) {
        if (const auto* random = std::get_if<emulator::RandomLoss>(&law))
            sum += 2.0 * random->share.fraction();
        if (const auto* burst = std::get_if<emulator::Burst>(&law)) sum += burst->lost / 40.0;
    }
    return sum;
}

/// T1 is usable up to a badness of 1, and good up to one half. T2 fails on every network, T3 on
/// none.
base::Result<experiment::PlayedSession> play(const experiment::SessionSpec& spec)
{
    experiment::PlayedSession played;
    played.metrics.task = spec.setting.task;
    played.metrics.scored_s = 27.0;
    const double bad = spec.setting.task == device::Task::t1   ? badness(spec)
                       : spec.setting.task == device::Task::t2 ? 2.0
                                                               : 0.0;
    const double apart_m = 10e-3 * bad;
    played.metrics.discrepancy_m = metrics::Spread{apart_m, apart_m, apart_m, 0.0};
    played.metrics.rate_bit_per_s = 1.2e6 / spec.setting.players[0].send.every;
    return played;
}

std::map<std::string, Table> found(const std::vector<std::string>& settings = {})
{
    const auto experiment =
        *experiment::parse_experiment(all_factors, "test.toml", {false, settings});
    std::vector<experiment::JobResult> results;
    for (const experiment::Job& job : make_jobs(experiment))
        results.push_back(*run_job(job, experiment, criteria(), play));
    std::map<std::string, Table> tables;
    const auto all = find_results(experiment, criteria(), results).value();
    for (const Table& table : all.tables) tables[table.name] = filled(table);
    return tables;
}

/// All tables of the unchanged experiment, made once.
const std::map<std::string, Table>& of_all_factors()
{
    static const auto tables = found();
    return tables;
}

/// A requirement that just accepts the promises of a class.
Requirement bearing(const NetworkClass& network)
{
    return {.delay_ms = network.delay_ms,
            .delay_variation_ms = network.delay_variation_ms.value_or(1000.0),
            .delay_variation_bound = network.delay_variation_ms ? Bound::found : Bound::open,
            .loss_percent = network.loss_percent};
}

TEST(Requirements, AreTheLimitsOfEachFactorByTierAndTask)
{
    const auto& tables = of_all_factors();
    const Rows rows = rows_of(tables.at("requirements"));
    ASSERT_EQ(rows.size(), 8U) << "three tasks and their worst, for two tiers";
    const auto near = [&](std::size_t row, std::string_view key, double expected, double within) {
        const auto value = rows[row].number(key);
        ASSERT_TRUE(value) << key;
        // The limit lies between the last level that passes and the first that fails.
        EXPECT_NEAR(*value, expected, within) << key << " of row " << row;
    };
    for (const std::size_t row : {0U, 4U}) {
        const double share = row == 0 ? 0.5 : 1.0;
        EXPECT_EQ(rows[row].text("task"), "T1");
        EXPECT_EQ(rows[row].text("tier"), row == 0 ? "good" : "usable");
        near(row, "delay_ms", share * 100.0 + 0.5, 0.5);
        near(row, "delay_variation_ms", 1.998 * (share * 10.0 + 0.5), 1.0);
        near(row, "loss_percent", share * 50.0 + 0.5, 0.5);
        near(row, "burst_of_100", share * 40.0 + 0.5, 0.5);
        near(row, "interval_ms", share * 10.0, 0.0);
        near(row, "messages_per_s", 100.0 / share, 1e-9);
        near(row, "rate_kbit_s", 120.0 / share, 1e-9);
        for (const char* bound : {"delay_bound", "delay_variation_bound", "loss_bound",
                                  "burst_bound", "interval_bound"})
            EXPECT_EQ(rows[row].text(bound), "=");
        EXPECT_EQ(rows[row].number("seeds"), 6.0);
        EXPECT_EQ(rows[row].number("first_seed"), 1.0);
        EXPECT_EQ(rows[row].text("classes"), "none") << "50 ms of variation are too much";
    }
}

TEST(Requirements, ThatFailAtRestHaveNoValueAndNoClass)
{
    const auto& tables = of_all_factors();
    const Rows rows = rows_of(tables.at("requirements"));
    for (const std::size_t row : {1U, 3U, 5U, 7U}) { // T2, and so the worst
        EXPECT_EQ(rows[row].text("task"), row % 4 == 1 ? "T2" : "worst");
        for (const char* factor : {"delay", "delay_variation", "loss", "burst", "interval"})
            EXPECT_EQ(rows[row].text(std::string{factor} + "_bound"), "none") << factor;
        for (const char* key : {"delay_ms", "delay_variation_ms", "loss_percent", "burst_of_100",
                                "interval_ms", "messages_per_s", "rate_kbit_s"})
            EXPECT_EQ(rows[row].number(key), std::nullopt) << key;
        EXPECT_EQ(rows[row].text("classes"), "none");
    }
}

TEST(Requirements, ThatNothingFailsAreAtLeastTheTopOfEachRange)
{
    const auto& tables = of_all_factors();
    const Rows rows = rows_of(tables.at("requirements"));
    for (const std::size_t row : {2U, 6U}) {
        EXPECT_EQ(rows[row].text("task"), "T3");
        const std::map<std::string, double> tops{{"delay_ms", 200.0},
                                                 {"loss_percent", 90.0},
                                                 {"burst_of_100", 90.0},
                                                 {"interval_ms", 50.0},
                                                 {"messages_per_s", 20.0}};
        for (const auto& [key, top] : tops) EXPECT_EQ(rows[row].number(key), top) << key;
        EXPECT_DOUBLE_EQ(*rows[row].number("delay_variation_ms"), 1.998 * 40.0);
        EXPECT_DOUBLE_EQ(*rows[row].number("rate_kbit_s"), 24.0);
        for (const char* factor : {"delay", "delay_variation", "loss", "burst", "interval"})
            EXPECT_EQ(rows[row].text(std::string{factor} + "_bound"), ">") << factor;
        EXPECT_EQ(rows[row].text("classes"), "0 2") << "400 ms were not tried";
    }
}

TEST(Requirements, AreThereWhereAllFactorsAreSearchedAndTiersStandInTheLimits)
{
    const auto& tables = of_all_factors();
    EXPECT_EQ(rows_of(tables.at("limits")).front().text("tier"), "good");
    EXPECT_EQ(tables.at("limits").rows.size(), 5U * 2U * 4U);
    EXPECT_EQ(csv_text(tables.at("network_classes")),
              "class,delay_ms,delay_variation_ms,loss_percent\n"
              "0,100,50,0.1\n1,400,50,0.1\n2,100,,0.1\n3,400,,0.1\n4,1000,,0.1\n");
    const auto usable = found({"tiers=usable", "tasks=T1"});
    EXPECT_FALSE(usable.at("limits").place_of("tier")) << "the tier of every other experiment";
    ASSERT_EQ(usable.at("requirements").rows.size(), 2U);
    EXPECT_EQ(rows_of(usable.at("requirements")).front().text("tier"), "usable");
    const auto fails_by = rows_of(tables.at("limits")).front().text("decided_by");
    EXPECT_EQ(fails_by, "copies apart") << "what keeps a session from being good";
}

TEST(NetworkClasses, SufficeUpToTheirOwnBoundsAndNotAHairBeyond)
{
    for (const NetworkClass& network : network_classes) {
        EXPECT_TRUE(suffices(network, bearing(network))) << network.number;
        for (auto Requirement::*factor : {&Requirement::delay_ms, &Requirement::loss_percent}) {
            Requirement less = bearing(network);
            *(less.*factor) *= 0.999;
            EXPECT_FALSE(suffices(network, less)) << network.number;
            (less.*factor).reset();
            EXPECT_FALSE(suffices(network, less)) << network.number << ": it fails at rest";
        }
        Requirement less = bearing(network);
        less.delay_variation_ms = 49.9;
        less.delay_variation_bound = Bound::found;
        EXPECT_FALSE(suffices(network, less)) << network.number;
    }
    Requirement some = bearing(network_classes[0]);
    some.delay_variation_ms = 500.0;
    EXPECT_FALSE(suffices(network_classes[2], some)) << "the class promises not even that";
}

TEST(NetworkClasses, SufficeTogetherWhereTheStricterClassIsEasier)
{
    Requirement all = bearing(network_classes[4]);
    for (const NetworkClass& network : network_classes) EXPECT_TRUE(suffices(network, all));
    all.delay_ms = 399.0;
    EXPECT_TRUE(suffices(network_classes[2], all));
    EXPECT_FALSE(suffices(network_classes[3], all));
    EXPECT_FALSE(suffices(network_classes[1], all));
}

} // namespace
} // namespace hapnet::lab::results

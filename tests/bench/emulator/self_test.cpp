// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/between.hpp"
#include "tests/bench/emulator/busy_rows.hpp"
#include "tests/bench/emulator/lateness.hpp"
#include "tests/bench/emulator/machine.hpp"
#include "tests/bench/emulator/probe.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>
#include <utility>

namespace hapnet::bench {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

Row row(std::string metric, double value)
{
    return {.name = "1 kpps, 10 ms",
            .subject = "s",
            .baseline = "",
            .metric = std::move(metric),
            .value = value,
            .baseline_value = std::nullopt,
            .target = std::nullopt};
}

TEST(Rows, JudgeTheValueOrTheRatioByTheNameOfTheMetric)
{
    Row one = row("p50_us", 10.0);
    EXPECT_EQ(one.met(), std::nullopt);
    one.baseline_value = 60.0;
    one.target = 5.0;
    EXPECT_EQ(one.met(), false); // 10 us are more than 5
    one.metric = "p50_ratio";
    one.direction = Direction::at_least;
    EXPECT_EQ(one.ratio(), 6.0); // baseline / value
    EXPECT_EQ(one.met(), true);
    one.target = 6.5;
    EXPECT_EQ(one.met(), false);
    one.baseline_value.reset();
    EXPECT_EQ(one.met(), false); // a ratio that could not be measured meets no target
}

TEST(Rows, ABoundThatIsReachedExactlyIsMet)
{
    Row one = row("min_us", 0.0);
    one.target = 0.0;
    EXPECT_EQ(one.met(), true);
    one.direction = Direction::at_least;
    EXPECT_EQ(one.met(), true);
}

TEST(Rows, BecomeJsonWithEveryFieldAndNullForWhatThereIsNot)
{
    Row full = row("p50_ratio", 10.0);
    full.baseline = "timerfd-relay";
    full.baseline_value = 60.0;
    full.target = 5.0;
    full.direction = Direction::at_least;
    const std::vector<Row> rows{full, row("p50_us", std::nan(""))};
    const auto json = Json::parse(rows_json({"cpu", "6.18", 2, true, 0.5}, rows));
    EXPECT_EQ(
        json["host"],
        (Json{{"cpu", "cpu"}, {"cores", 2}, {"kernel", "6.18"}, {"fifo", true}, {"load", 0.5}}));
    EXPECT_EQ(json["rows"][0], (Json{{"case", "1 kpps, 10 ms"},
                                     {"subject", "s"},
                                     {"baseline", "timerfd-relay"},
                                     {"metric", "p50_ratio"},
                                     {"value", 10.0},
                                     {"baseline_value", 60.0},
                                     {"ratio", 6.0},
                                     {"target", 5.0},
                                     {"direction", "min"},
                                     {"met", true}}));
    const auto& bare = json["rows"][1];
    EXPECT_EQ(bare.size(), 10U);
    EXPECT_EQ(bare["direction"], "max");
    for (const char* key : {"baseline", "value", "baseline_value", "ratio", "target", "met"}) {
        EXPECT_TRUE(bare[key].is_null()) << key;
    }
}

TEST(Prober, SeesADirectPathThatLosesAndReordersNothing)
{
    Prober prober{Sending::ordinary};
    const auto trial = prober.measure_timing({prober.b(), 10'000.0, 20ms, 0ms});
    EXPECT_EQ(trial.tally.sent, 200U);
    EXPECT_EQ(trial.tally.received, 200U);
    EXPECT_EQ(trial.tally.reordered, 0U);
    EXPECT_EQ(trial.errors.size(), 200U);
}

TEST(Prober, CountsWhatItSendsItselfAtAHighRateInBothWaysOfSending)
{
    for (const Sending sending : {Sending::ordinary, Sending::offload}) {
        Prober prober{sending};
        const auto trial = prober.measure_rate({prober.b(), 20'000.0, 20ms, 0ms});
        EXPECT_GT(trial.tally.sent, 0U);
        EXPECT_EQ(trial.tally.received, trial.tally.sent);
        EXPECT_EQ(trial.missing, 0.0);
    }
}

TEST(Prober, NoticesWhatIsMissing)
{
    Prober prober{Sending::offload};
    const Prober elsewhere{Sending::ordinary};
    const auto trial = prober.measure_rate({elsewhere.b(), 20'000.0, 20ms, 0ms});
    EXPECT_EQ(trial.tally.received, 0U);
    EXPECT_EQ(trial.missing, 1.0);
}

TEST(Prober, KnowsWhenEachWasDueAndHowLateItWas)
{
    Prober prober{Sending::ordinary};
    const auto trial = prober.measure_timing({prober.b(), 10'000.0, 20ms, 0ms});
    ASSERT_LE(trial.departures.size(), trial.errors.size()); // stopped sends are left out
    ASSERT_FALSE(trial.departures.empty());
    for (std::size_t i = 1; i < trial.departures.size(); ++i) {
        EXPECT_GT(trial.departures[i].due, trial.departures[i - 1].due);
    }
}

base::TimePoint at(base::Duration time) { return base::TimePoint{} + time; }

TEST(Stalls, AreWaitsLongerThanTheLimitAndThoseThatOverlapAreOne)
{
    // Nothing leaves from 10 ms to 60 ms. A datagram that is due at 56 ms waits only 4 ms.
    std::vector<Departure> departures;
    for (int ms = 0; ms < 100; ++ms) {
        const base::Duration due = ms * 1ms;
        const base::Duration late = ms >= 10 && ms < 60 ? 60ms - due : 0ms;
        departures.push_back({at(due), late});
    }
    const Stalls one = stalls_in(departures, 5ms);
    EXPECT_EQ(one.count, 1U);
    EXPECT_EQ(one.longest, 50ms);

    departures.push_back({at(200ms), 6ms});
    std::swap(departures.front(), departures.back()); // in any order
    const Stalls two = stalls_in(departures, 5ms);
    EXPECT_EQ(two.count, 2U);
    EXPECT_EQ(two.longest, 50ms);
    EXPECT_EQ(stalls_in({{at(1ms), 5ms}}, 5ms).count, 0U); // not longer than the limit
    EXPECT_EQ(stalls_in({}, 5ms).count, 0U);
}

TEST(BusyProcesses, KeepEachProcessorBusyAndEnd)
{
    std::vector<pid_t> ids;
    {
        const BusyProcesses busy;
        ids = busy.ids();
        EXPECT_EQ(ids.size(), static_cast<std::size_t>(sysconf(_SC_NPROCESSORS_ONLN)));
        for (const pid_t id : ids) {
            while (time_used_by(id) < 20ms) usleep(1000); // or until the test's time is over
        }
    }
    for (const pid_t id : ids) EXPECT_EQ(kill(id, 0), -1) << id;
}

/// A relay whose datagrams are all equally late.
BesideBusy relay(base::Duration late, std::size_t stalls, base::Duration used)
{
    return {.errors = std::vector<base::Duration>(100, late),
            .stalls = stalls,
            .longest_stall = 0ms,
            .lost = 0,
            .used = used,
            .took = 1s};
}

/// True if the row of a metric is met; nullopt when it is not judged.
std::optional<bool> met(const std::vector<Row>& rows, std::string_view subject,
                        std::string_view metric)
{
    for (const Row& row : rows) {
        if (row.subject == subject && row.metric == metric) return row.met();
    }
    ADD_FAILURE() << "no row of " << metric;
    return std::nullopt;
}

TEST(BesideBusy, IsJudgedByTheTimerfdRelayAsLongAsThatOneKeepsUp)
{
    const auto rows_with = [](double rate, base::Duration timerfd_used, bool fifo) {
        return rows_beside_busy(rate,
                                {{eco.name, relay(100us, 1, 300ms)},
                                 {precise.name, relay(200us, 2, 600ms)},
                                 {timerfd_relay.name, relay(150us, 1, timerfd_used)}},
                                fifo);
    };
    const auto rows = rows_with(10'000.0, 790ms, true);
    EXPECT_EQ(met(rows, eco.name, "p99_us"), true);
    EXPECT_EQ(met(rows, eco.name, "stalls_over_5ms"), true);
    EXPECT_EQ(met(rows, precise.name, "p99_us"), false);
    EXPECT_EQ(met(rows, precise.name, "stalls_over_5ms"), false);
    EXPECT_EQ(met(rows, precise.name, "p50_us"), std::nullopt);
    EXPECT_EQ(met(rows, timerfd_relay.name, "p99_us"), std::nullopt);
    for (const auto& unjudged :
         {rows_with(10'000.0, 800ms, true), rows_with(20'000.0, 1ms, false)}) {
        for (const Row& row : unjudged) EXPECT_EQ(row.met(), std::nullopt) << row.metric;
    }
    // At 20 kpps the default has its own bound, whatever the other relay does.
    EXPECT_EQ(met(rows_with(20'000.0, 900ms, true), precise.name, "p99_us_of_the_default"), true);
}

TEST(BesideBusy, AddsUpItsTrials)
{
    BesideBusy sum;
    TimingTrial trial;
    trial.errors = {1ms, 7ms};
    trial.departures = {{at(0ms), 1ms}, {at(50ms), 7ms}};
    trial.tally = {.sent = 3, .received = 2, .reordered = 0};
    sum.add(trial);
    sum.add(trial);
    EXPECT_EQ(sum.errors.size(), 4U);
    EXPECT_EQ(sum.stalls, 2U);
    EXPECT_EQ(sum.longest_stall, 7ms);
    EXPECT_EQ(sum.lost, 2U);
}

TEST(Between, IsJudgedByWhatAProbeHasPrintedBehindOtherLines)
{
    const auto rows = rows_of_round_trips(
        "ready answer=0.0.0.0:7002\n"
        R"({"answered": 9, "round_trip": {"delay_ms": {"min": 79.999, "p50": 80.1, "p99": 80.5}}})"
        "\n");
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_NEAR(rows[0].value, 100.0, 1e-6);
    EXPECT_EQ(rows[0].met(), true);
    EXPECT_EQ(rows[1].met(), false); // 500 us are more than 400
    EXPECT_EQ(rows[2].met(), false); // early by 1 us
    EXPECT_TRUE(rows_of_round_trips("").empty());
    EXPECT_TRUE(rows_of_round_trips("{").empty());
    EXPECT_TRUE(
        rows_of_round_trips(R"({"answered": 0, "round_trip": {"delay_ms": null}})").empty());
}

} // namespace
} // namespace hapnet::bench

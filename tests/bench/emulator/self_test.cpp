// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/probe.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

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
    EXPECT_EQ(one.met(), false); // a ratio that nobody could measure meets nothing
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

} // namespace
} // namespace hapnet::bench

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/path_meter.hpp"

#include "tests/unit/peer/core/pair.hpp"

#include <gtest/gtest.h>
#include <initializer_list>

namespace hapnet::peer::path_meter_test {
namespace {

constexpr base::TimePoint start{1h};
constexpr ClockEstimate ahead{.offset = 5s}; // of the other side's clock

/// State n of a side that sends one each millisecond. It is sent at n ms on this clock, and arrives
/// after `delay`.
struct Arrival {
    std::uint32_t sequence = 1;
    base::Duration delay{40ms};
};

wire::State state_of(std::uint32_t sequence)
{
    wire::State state;
    state.sequence = sequence;
    state.sent = start + sequence * 1ms + ahead.offset;
    return state;
}

void hear(PathMeter& meter, const Arrival& each, std::optional<ClockEstimate> clock = ahead)
{
    meter.on_state(state_of(each.sequence), start + each.sequence * 1ms + each.delay, clock);
}

double ms(base::Duration time) { return 1e3 * base::to_seconds(time); }

TEST(PathMeter, HasNothingToSayBeforeTheFirstState)
{
    const PathsReport report = PathMeter{}.report();
    EXPECT_EQ(report.arrived.sent, 0U);
    EXPECT_FALSE(report.loss);
    EXPECT_FALSE(report.in.delay || report.in.jitter || report.in.age.mean);
    EXPECT_FALSE(report.out.delay || report.out.jitter || report.out.age.mean);
}

TEST(PathMeter, CountsWhatIsMissingDuplicatedAndOvertakenUpToTheHighestNumber)
{
    PathMeter meter;
    for (const std::uint32_t sequence : {2U, 3U, 3U, 7U, 5U, 2U, 10U}) hear(meter, {sequence});
    const auto report = meter.report();
    EXPECT_EQ(report.arrived.sent, 10U);
    EXPECT_EQ(report.arrived.received, 5U);
    EXPECT_EQ(report.arrived.duplicates, 2U);
    EXPECT_EQ(report.arrived.reordered, 1U);
    EXPECT_EQ(report.loss, 0.5);
}

TEST(PathMeter, TakesADuplicateThatIsTooOldToTellForAnother)
{
    constexpr auto far = static_cast<std::uint32_t>(PathMeter::looks_back);
    PathMeter meter;
    for (const std::uint32_t sequence : {1U, far, 1U}) hear(meter, {sequence});
    EXPECT_EQ(meter.report().arrived.duplicates, 1U);
    for (const std::uint32_t sequence : {far + 1, 1U}) hear(meter, {sequence});
    EXPECT_EQ(meter.report().arrived.duplicates, 1U);
    EXPECT_EQ(meter.report().arrived.received, 4U);
}

TEST(PathMeter, LosesNothingWhereOldDuplicatesCountAsReceived)
{
    PathMeter meter;
    for (std::uint32_t sequence = 1; sequence <= 2000; ++sequence) hear(meter, {sequence});
    hear(meter, {1});
    EXPECT_EQ(meter.report().arrived.received, 2001U);
    EXPECT_EQ(meter.report().loss, 0.0);
}

TEST(PathMeter, AgesOnlyTheNewestOfStatesThatArriveTogether)
{
    PathMeter meter;
    for (const Arrival& each : {Arrival{1, 90ms}, Arrival{2, 89ms}, Arrival{3, 90ms}}) {
        hear(meter, each);
    }
    // From 89 ms to 91 ms. The first state was never the newest for any time.
    const auto in = meter.report().in;
    EXPECT_EQ(in.age.peak_max, 91ms);
    EXPECT_EQ(in.age.mean, 90ms);
    hear(meter, {4, 10ms}); // its stamp is older than that of the one before
    EXPECT_EQ(meter.report().in.age.mean, 90ms);
}

TEST(PathMeter, MeasuresDelayJitterAndAgeOfWhatComesIn)
{
    PathMeter meter;
    // Arrive at 41, 48 and 43 ms, the last one overtaken.
    for (const Arrival& each : {Arrival{1, 40ms}, Arrival{8, 40ms}, Arrival{3, 50ms}}) {
        hear(meter, each);
    }
    const auto in = meter.report().in;
    ASSERT_TRUE(in.delay && in.jitter && in.age.mean);
    EXPECT_EQ(in.delay->max, 50ms);
    EXPECT_NEAR(ms(in.delay->p50), 40.0, 0.7); // bins of 1/64
    EXPECT_EQ(in.jitter->max, 10ms);
    // From 40 ms at the first arrival to 47 ms at the next newer one.
    EXPECT_EQ(in.age.peak_max, 47ms);
    EXPECT_NEAR(ms(*in.age.mean), 43.5, 1e-6);
}

TEST(PathMeter, AddsNothingToDelaysWhileTheClockIsUnknownAndComparesNothingAcrossThat)
{
    PathMeter meter;
    hear(meter, {1, 40ms});
    hear(meter, {2, 90ms}, std::nullopt);
    hear(meter, {3, 60ms});
    EXPECT_EQ(meter.report().arrived.received, 3U);
    const auto in = meter.report().in;
    EXPECT_EQ(in.delay->max, 60ms);
    EXPECT_FALSE(in.jitter);
    EXPECT_FALSE(in.age.mean);
}

TEST(PathMeter, LearnsOfTheOtherDirectionByEchoes)
{
    PathMeter meter;
    const auto hear_echo = [&](std::uint32_t sequence, base::Duration of, base::Duration age) {
        wire::State state = state_of(sequence);
        state.echo = wire::Echo{start + of, age};
        meter.on_state(state, start + sequence * 1ms + 40ms, ahead);
    };
    hear_echo(98, -900ms, 960ms); // of a hello before the start
    hear_echo(99, -900ms, 961ms);
    hear_echo(100, 69ms, 1ms);  // was on its way for 30 ms
    hear_echo(101, 69ms, 2ms);  // of the same message, now 32 ms old
    hear_echo(102, 50ms, 52ms); // an older one: no news
    hear_echo(110, 90ms, 0ms);
    const auto out = meter.report().out;
    ASSERT_TRUE(out.delay && out.jitter && out.age.mean);
    EXPECT_EQ(out.delay->max, 30ms);
    EXPECT_EQ(out.jitter->max, 10ms);
    EXPECT_EQ(out.age.peak_max, 52ms);
    EXPECT_NEAR(ms(*out.age.mean), (31.0 + 32.0 + 52.0 + 20.0) / 4.0, 1e-6);
}

TEST(PathMeter, IsInAPeerThatIsToMeasureAndBeginsAnewWithEachSession)
{
    Pair pair;
    Settings measuring = settings_of(0);
    measuring.measures_paths = true;
    pair.start(0, measuring);
    pair.run_until_started();
    pair.run_for(2s);
    const auto paths = pair.peers[0]->others().front().paths();
    EXPECT_GE(paths.arrived.received, 2000U);
    EXPECT_EQ(paths.loss, 0.0);
    EXPECT_EQ(paths.in.delay->max, 1ms); // as the pair's path is
    EXPECT_EQ(paths.out.delay->max, 1ms);
    EXPECT_EQ(paths.in.age.peak_max, 2ms);
    EXPECT_EQ(pair.peers[1]->others().front().paths().arrived.received, 0U);
    pair.start(1, settings_of(1, 1));
    pair.run_for(1s);
    EXPECT_LE(pair.peers[0]->others().front().paths().arrived.received, 1000U);
    EXPECT_GE(pair.peers[0]->others().front().paths().arrived.received, 500U);
}

} // namespace
} // namespace hapnet::peer::path_meter_test

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/analysis.hpp"

#include "tests/unit/lab/records/recording.hpp"

#include <limits>
#include <string>
#include <vector>

namespace hapnet::lab::records {
namespace {

std::string refusal(Recording& a, Recording& b)
{
    const auto analysis = analyse(a.content(), b.content());
    return analysis ? "accepted" : analysis.error().message;
}

/// Sets `late` in the first `ticks` ticks of a second.
auto late_in(int ticks, base::Duration late)
{
    return [=](record::TickRow& row, base::Duration time) {
        if (time < ticks * 1ms) row.late = late;
    };
}

/// The analysis of a second in which B is perfect and A is as `fill` makes it.
Analysis with_a(auto&& fill)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(0s, 1s, Phase::running, fill);
    b.session(1s).ticks(0s, 1s);
    return analysis_of(a, b);
}

TEST(Analysis, RefusesTwoRecordsOfOnePeer)
{
    Recording a{1};
    a.session(1s);
    EXPECT_EQ(refusal(a, a), "both records were written by peer 1: give one of each peer");
}

TEST(Analysis, RefusesRecordsOfDifferentRuns)
{
    Recording a{1};
    Recording b{2};
    a.session({.session = 1});
    EXPECT_EQ(refusal(a, b), "the records share no session: were they made in the same run?");
    b.session({.session = 2});
    EXPECT_EQ(refusal(a, b), "the records share no session: were they made in the same run?");
}

TEST(Analysis, SaysWhatTheConfigurationOfARecordLacks)
{
    Recording good{1};
    Recording bad{2};
    bad.content().config["tick_ns"] = "1ms";
    EXPECT_EQ(refusal(good, bad),
              "record B: its config has no whole number \"tick_ns\" up to a second");
    bad.content().config.erase("boot_id");
    EXPECT_EQ(refusal(bad, good), "record A: its config has no text \"boot_id\"");
    bad.content().config = nlohmann::json::object();
    EXPECT_EQ(refusal(bad, good), "record A: its config has no whole number \"peer_id\"");
}

TEST(Analysis, TakesTheLastSessionThatBothKnowAndOnlyItsTicks)
{
    Recording a{1};
    Recording b{2};
    a.session({.start = start, .length = 1s, .session = 4}).ticks(0ms, 5ms);
    a.session({.start = start, .length = 1s, .session = 7}).ticks(5ms, 15ms);
    a.session({.start = start, .length = 1s, .session = 9}).ticks(15ms, 18ms);
    b.session({.start = start, .length = 1s, .session = 7}).ticks(0ms, 18ms);
    const Analysis analysis = analysis_of(a, b);
    EXPECT_EQ(analysis.a.ticks, 10U);
    EXPECT_EQ(analysis.agreement.scored, 10ms);
}

TEST(Analysis, TakesTheNewestTermsOfASession)
{
    Recording a{1, "boot of A"};
    Recording b{2, "boot of B"};
    a.session({.start = start, .length = 1s, .remote_offset = 9s, .session = 1}).ticks(0ms, 5ms);
    a.session({.start = start,
               .length = 1s,
               .remote_offset = 8s,
               .offset_uncertainty = 3ms,
               .session = 1});
    b.session(1s);
    const Analysis analysis = analysis_of(a, b);
    EXPECT_EQ(analysis.clock.method, ClockMethod::echo);
    EXPECT_EQ(analysis.clock.offset, 8s);
    EXPECT_EQ(analysis.clock.uncertainty, 3ms);
    EXPECT_EQ(analysis.a.ticks, 5U);
}

TEST(Analysis, IgnoresTheEchoOffsetWithinOneBootUnlessItRulesOneClockOut)
{
    for (const base::Duration offset : {base::Duration{4ms}, base::Duration{-8s}}) {
        Recording a{1};
        Recording b{2};
        a.session({.start = start,
                   .length = 1s,
                   .remote_offset = offset,
                   .offset_uncertainty = 5ms,
                   .session = 1});
        b.session(1s);
        const auto clock = analysis_of(a, b).clock;
        const bool is_ruled_out = offset == -8s;
        EXPECT_EQ(clock.method, is_ruled_out ? ClockMethod::echo : ClockMethod::same_boot);
        EXPECT_EQ(clock.offset, is_ruled_out ? offset : base::Duration{0});
    }
}

TEST(Analysis, ReckonsWithTheSkewOfTheEchoClock)
{
    const record::SessionRow row{.remote_offset = 8s,
                                 .offset_uncertainty = 1ms,
                                 .other = 2,
                                 .noted_at = start + 10s,
                                 .remote_skew_ppm = 100.0};
    const Clock clock = clock_of(row);
    EXPECT_EQ(clock.to_b(start + 10s), start + 18s);
    EXPECT_EQ(clock.to_a(start + 18s), start + 10s);
    // 10 s before: it was 1 ms less ahead, up to rounding to whole nanoseconds.
    EXPECT_LE(std::chrono::abs(clock.to_b(start) - (start + 8s - 1ms)), 1ns);
    EXPECT_LE(std::chrono::abs(clock.to_a(start + 8s - 1ms) - start), 1ns);
    record::SessionRow damaged = row;
    damaged.remote_skew_ppm = 1e300;
    EXPECT_EQ(clock_of(damaged).to_b(start), start + 8s);
}

TEST(Analysis, TakesOfInterleavedSessionsThoseOfTheTwo)
{
    Recording a{1};
    Recording b{3};
    const auto row = [](std::uint32_t session, std::uint16_t other, base::Duration offset) {
        return record::SessionRow{.start = start,
                                  .length = 1s,
                                  .remote_offset = offset,
                                  .session = session,
                                  .other = other};
    };
    a.session(row(12, 2, 1s)).session(row(13, 3, 2s)).ticks(0ms, 5ms);
    a.session(row(12, 2, 3s)).session(row(13, 3, 4s)).ticks(5ms, 15ms);
    a.session(row(14, 2, 5s)).ticks(15ms, 18ms); // the other peer was restarted
    b.session(row(13, 1, 0s)).ticks(0ms, 18ms);
    const auto session = common_session(a.content(), b.content());
    ASSERT_TRUE(session) << session.error().message;
    EXPECT_EQ(session->a.terms.remote_offset, 4s);
    EXPECT_EQ(session->a.ticks.size(), 18U);
}

TEST(Analysis, DoesNotTakeTwoUnknownBootsForOne)
{
    Recording a{1, ""};
    Recording b{2, ""};
    a.session({.start = start, .length = 1s, .remote_offset = 8s, .session = 1});
    b.session(1s);
    EXPECT_EQ(analysis_of(a, b).clock.method, ClockMethod::echo);
}

TEST(Loop, CountsFromT0ToTheEndOfThePeerAndNotTheCountdown)
{
    Recording a{1};
    Recording b{2};
    const auto slow = late_in(9999, 5ms);
    a.session(3ms).ticks(-1s, 0s, Phase::countdown, slow).ticks(0ms, 1ms);
    a.ticks(1ms, 2ms, Phase::hands_off).ticks(2ms, 3ms, Phase::alone);
    a.ticks(3ms, 9ms, Phase::ended, slow);
    b.session(3ms);
    const Loop loop = analysis_of(a, b).a;
    EXPECT_EQ(loop.ticks, 3U);
    EXPECT_EQ(loop.rate_hz, 1000.0);
    EXPECT_EQ(loop.late.value().max, 0ms);
}

TEST(Loop, HasNoRateWithoutTwoTicks)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(0ms, 1ms);
    b.session(1s);
    const Analysis analysis = analysis_of(a, b);
    EXPECT_FALSE(analysis.a.rate_hz);
    EXPECT_TRUE(analysis.a.late);
    EXPECT_FALSE(analysis.b.late);
}

TEST(Verdict, IsValidWhenAllIsWell)
{
    const Analysis analysis = with_a([](record::TickRow&, base::Duration) {});
    EXPECT_TRUE(analysis.valid()) << analysis.invalid_because.front();
}

TEST(Verdict, IsValidWithALatenessOfOneMillisecondAndNotWithOneNanosecondMore)
{
    EXPECT_TRUE(with_a(late_in(1000, 1ms)).valid());
    EXPECT_TRUE(with_a(late_in(10, 1ms + 1ns)).valid());
    EXPECT_EQ(with_a(late_in(11, 1500us)).invalid_because,
              std::vector<std::string>{"A: p99 tick lateness 1.500 ms is above 1 ms"});
}

TEST(Verdict, IsValidWithHalfAPercentOfTheTicksMissedAndNotWithOneMore)
{
    // 995 of 1000 ticks were made. B's ticks fill no gap in A.
    const auto missing = [](std::uint32_t missed) {
        Recording a{1};
        Recording b{2};
        a.session(995ms).ticks(0ms, 995ms);
        a.content().ticks.back().missed_before = missed;
        b.session(995ms).ticks(0ms, 995ms);
        return analysis_of(a, b);
    };
    EXPECT_TRUE(missing(5).valid());
    EXPECT_EQ(missing(6).a.missed, 6U);
    EXPECT_EQ(missing(6).invalid_because,
              std::vector<std::string>{"A: 0.60 % of the ticks missed, more than 0.5 %"});
}

TEST(Verdict, IsNotValidWhenTheSessionsOverlapTooLittle)
{
    Recording a{1};
    Recording b{2};
    a.session(1s).ticks(0s, 1s);
    b.session(1s).ticks(0s, 949ms);
    EXPECT_EQ(analysis_of(a, b).invalid_because,
              std::vector<std::string>{"the sessions overlap 94.9 %, less than 95 %"});
    b.ticks(949ms, 950ms);
    EXPECT_TRUE(analysis_of(a, b).valid());
}

TEST(Verdict, IsNotValidWhenAPositionIsNotFinite)
{
    const Analysis analysis = with_a([](record::TickRow& row, base::Duration) {
        row.cube = {{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}};
    });
    EXPECT_EQ(analysis.invalid_because,
              std::vector<std::string>{"positions or forces were not finite"});
}

} // namespace
} // namespace hapnet::lab::records

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/replay/replay.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::device::replay_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

std::string complaint(std::string_view text)
{
    const auto trace = parse_hand_trace(text, "hand.csv");
    return trace ? "" : trace.error().message;
}

TEST(HandTrace, IsReadFromPlainCsv)
{
    const auto trace = parse_hand_trace("time_s,x_m,y_m,z_m,gripping\n"
                                        "-0.5,0.01,0,-1e-3,0\n"
                                        "1,0.02,0.03,0.04,1\n",
                                        "hand.csv");
    ASSERT_TRUE(trace);
    const HandTrace expected{{-0.5, {{0.01, 0.0, -0.001}}, false},
                             {1.0, {{0.02, 0.03, 0.04}}, true}};
    EXPECT_EQ(*trace, expected);
}

TEST(HandTrace, IsReadFromAnExportedRecordAndWithTheLineEndsOfOtherSystems)
{
    const auto trace = parse_hand_trace("time_s,tick,hip_x_mm,hip_y_mm,hip_z_mm,phase\r\n"
                                        "0.25,7,10,20,-30,running\r\n",
                                        "hand.csv");
    ASSERT_TRUE(trace);
    ASSERT_EQ(trace->size(), 1U);
    EXPECT_EQ(trace->front().time_s, 0.25);
    EXPECT_NEAR(trace->front().hip.z(), -0.030, 1e-15);
    EXPECT_FALSE(trace->front().gripping);
}

TEST(HandTrace, IsRefusedWithFileAndLine)
{
    constexpr auto header = "time_s,x_m,y_m,z_m\n";
    const auto after = [&](std::string_view lines) {
        return complaint(std::string{header} + std::string{lines});
    };
    EXPECT_EQ(complaint("").substr(0, 50), "hand.csv:1: the first line names the columns: time");
    EXPECT_EQ(complaint("time_s,x_m,y_m\n1,2,3\n").substr(0, 11), "hand.csv:1:");
    EXPECT_EQ(after(""), "hand.csv:1: no line of numbers follows");
    EXPECT_EQ(after("0,0,0,0\n0,0,0,0\n"), "hand.csv:3: the time 0 s does not come after 0 s");
    EXPECT_EQ(after("0,0,0\n"), "hand.csv:2: 3 cells where the first line names 4 columns");
    EXPECT_EQ(after("0,0,0,0,0\n"), "hand.csv:2: 5 cells where the first line names 4 columns");
    EXPECT_EQ(after("0,0,ten,0\n"), "hand.csv:2: 'ten' is not a coordinate within 10 m");
    EXPECT_EQ(after("0,0,11,0\n"), "hand.csv:2: '11' is not a coordinate within 10 m");
    EXPECT_EQ(after("nan,0,0,0\n"), "hand.csv:2: 'nan' is not a time in seconds");
    EXPECT_EQ(complaint("time_s,x_m,y_m,z_m,gripping\n0,0,0,0,yes\n"),
              "hand.csv:2: 'yes' does not say 0 or 1 for gripping");
}

Replay three_moments()
{
    return Replay{{{1.0, {{0.0, 0.0, 0.0}}, true},
                   {1.1, {{0.010, 0.0, 0.0}}, true},
                   {2.0, {{0.010, 0.009, 0.0}}, false}},
                  "hand.csv"};
}

TEST(Replay, GoesItsWayFromTheSessionsStartAndStaysAtItsEnd)
{
    Replay hand = three_moments();
    EXPECT_EQ(hand.read(start).hip, base::Position{}); // before its cue, at its start
    EXPECT_FALSE(hand.read(start).gripping);
    hand.on_cue({start + 1s, 27s, base::Seed{1}, 1, true});
    EXPECT_EQ(hand.read(start + 1900ms).hip, base::Position{});
    EXPECT_FALSE(hand.read(start + 1900ms).gripping);
    const Sample between = hand.read(start + 2050ms);
    EXPECT_NEAR(between.hip.x(), 0.005, 1e-15);
    EXPECT_TRUE(between.gripping);
    hand.apply(ungoverned({{3.0, 0.0, 0.0}})); // it does not give way
    EXPECT_NEAR(hand.read(start + 2600ms).hip.y(), 0.005, 1e-15);
    EXPECT_EQ(hand.read(start + 10s).hip, (base::Position{{0.010, 0.009, 0.0}}));
    EXPECT_FALSE(hand.read(start + 10s).gripping);
}

TEST(Replay, HasTheVelocityOfItsWay)
{
    Replay hand = three_moments();
    hand.on_cue({start, 27s, base::Seed{1}, 1, true});
    Sample sample;
    for (int ms = 0; ms <= 1100; ++ms) sample = hand.read(start + ms * 1ms);
    // 10 mm in 100 ms, through a low-pass whose time constant is 5.3 ms.
    EXPECT_NEAR(sample.velocity.x(), 0.1, 1e-6);
}

TEST(Replay, BeginsAgainAtItsEndWhenItIsTold)
{
    HandTrace trace{{2.0, {}, true}, {2.5, {{0.010, 0.0, 0.0}}, true}, {3.0, {}, true}};
    Replay hand{std::move(trace), "loop.csv", AfterTheEnd::begins_again};
    hand.on_cue({start, 27s, base::Seed{1}, 1, true});
    EXPECT_EQ(hand.read(start + 1s).hip, base::Position{});
    for (const auto round : {0s, 1s, 20s}) {
        EXPECT_NEAR(hand.read(start + round + 2250ms).hip.x(), 0.005, 1e-12);
        EXPECT_TRUE(hand.read(start + round + 2250ms).gripping);
    }
}

TEST(Replay, SaysWhatItPlays)
{
    EXPECT_EQ(description(three_moments()), "replay hand.csv: a recorded hand, 3 moments");
}

} // namespace
} // namespace hapnet::device::replay_test

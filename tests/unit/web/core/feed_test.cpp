// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Pairing, history and trap, from which the page's figures follow.
#include "web/core/history.hpp"
#include "web/core/pairing.hpp"
#include "web/core/trap.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::web {
namespace {

using std::chrono::milliseconds;

base::TimePoint at_ms(int ms) { return base::TimePoint{} + milliseconds{ms}; }

/// x = t^3, which a cubic follows exactly.
Sample cubic(int ms, int ahead_ms = 0)
{
    const double t = ms * 1e-3;
    return {at_ms(ms + ahead_ms), {t * t * t, 0.0, 0.0}, {3.0 * t * t, 0.0, 0.0}};
}

TEST(Pairing, FollowsACubicExactlyOnClocksThatDiffer)
{
    Track a;
    Track b;
    for (int ms = 0; ms <= 160; ms += 16) a.add(cubic(ms));
    for (int ms = 5; ms <= 149; ms += 16) b.add(cubic(ms, 700));
    const auto both = apart(a, b, milliseconds{700});
    ASSERT_TRUE(both);
    EXPECT_EQ(both->at, at_ms(149));
    EXPECT_NEAR(both->a.x, std::pow(0.149, 3), 1e-15);
    EXPECT_LT(both->along_x_m(), 1e-15);
}

TEST(Pairing, KnowsNothingBesideTheTrackAndAcrossAGap)
{
    Track track;
    track.add(cubic(100));
    track.add(cubic(100 + 301));
    EXPECT_FALSE(track.at(at_ms(99)));
    EXPECT_FALSE(track.at(at_ms(200)));
    EXPECT_FALSE(track.at(at_ms(402)));
    EXPECT_TRUE(track.at(at_ms(100)));
    EXPECT_FALSE(apart(track, Track{}, base::Duration{0}));
}

TEST(Feed, TakesOneBootForOneClockUnlessAnEchoRulesThatOut)
{
    Feed feed;
    feed.set_peers({{1, "a boot"}, {2, "a boot"}, {3, "another boot"}});
    EXPECT_TRUE(feed.share_clock(0, 1));
    EXPECT_FALSE(feed.share_clock(0, 2));
    for (const double offset_ms : {-8.0, 8.0, 5000.0}) {
        PeerFrame frame;
        frame.heard.push_back({.from = 2, .offset_ms = offset_ms, .uncertainty_ms = 10.0});
        feed.take_peer(0, frame);
        EXPECT_EQ(feed.share_clock(0, 1), offset_ms < 10.0) << offset_ms;
    }
}

TEST(Feed, TellsTheNewestFrameToAPageThatComesWhileTimeStandsStill)
{
    Feed feed;
    feed.set_peers({{1, "a boot"}, {2, "a boot"}});
    EXPECT_FALSE(feed.newest(0.0, at_ms(0))) << "nothing is attached";
    PeerFrame frame;
    frame.text = R"({"ok":true,"peer":1})";
    feed.take_peer(0, frame);
    ASSERT_TRUE(feed.next(2.0, at_ms(0)));
    const auto rows = feed.history().size();
    const auto again = feed.newest(2.0, at_ms(5));
    ASSERT_TRUE(again);
    const auto json = nlohmann::json::parse("{\"n\":1" + *again);
    EXPECT_EQ(json["at_s"], 2.0);
    EXPECT_EQ(json["peers"][0]["peer"], 1);
    EXPECT_EQ(json["peers"][0]["repeated"], true) << "what it counts has been told before";
    EXPECT_EQ(feed.history().size(), rows);
    feed.take_peer(0, frame);
    EXPECT_EQ(
        nlohmann::json::parse("{\"n\":1" + *feed.next(3.0, at_ms(9)))["peers"][0].count("repeated"),
        0U)
        << "it takes nothing away from the pages that look already";
}

TEST(History, KeepsThePeaksOfEightRows)
{
    History history;
    history.set_columns({"at_s", "late"});
    for (int i = 0; i < 16; ++i) {
        history.add({i * 0.5, i == 5 ? 900.0 : i == 11 ? -7.0 : i == 3 ? std::nan("") : 1.0});
    }
    EXPECT_EQ(history.size(), 16U);
    const auto coarse = nlohmann::json::parse(history.coarse_json());
    ASSERT_EQ(coarse["rows"].size(), 2U);
    EXPECT_EQ(coarse["rows"][0], nlohmann::json::parse("[0.0,[1,900]]"));
    EXPECT_EQ(coarse["rows"][1], nlohmann::json::parse("[4.0,[-7,1]]"));
    EXPECT_TRUE(nlohmann::json::parse(history.fine_json())["rows"][3][1].is_null());
}

TEST(Trap, FiresOnceAndRests)
{
    const std::array<std::string, 1> names{"apart_mm"};
    Trap trap;
    EXPECT_FALSE(trap.arm("nothing>3", Trap::last_usual, names));
    ASSERT_TRUE(trap.arm("apart_mm>30", Trap::last_usual, names));
    EXPECT_EQ(trap.step({{"apart_mm", 30.0}}, at_ms(0)), Trap::News::none);
    EXPECT_EQ(trap.step({{"apart_mm", 31.0}}, at_ms(1)), Trap::News::fired);
    EXPECT_EQ(trap.step({{"apart_mm", 31.0}}, at_ms(2000)), Trap::News::none);
    EXPECT_EQ(trap.step({{"apart_mm", 31.0}}, at_ms(2001)), Trap::News::wants_keep);
    EXPECT_EQ(trap.step({{"apart_mm", 31.0}}, at_ms(32000)), Trap::News::none);
    EXPECT_EQ(trap.step({{"apart_mm", 31.0}}, at_ms(32001)), Trap::News::armed_again);
    EXPECT_EQ(trap.fired(), 1U);
}

} // namespace
} // namespace hapnet::web

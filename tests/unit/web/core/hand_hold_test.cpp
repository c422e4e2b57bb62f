// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/hand_hold.hpp"

#include "device/page/page_hand.hpp"
#include "proto/control/core/request.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <string>

namespace hapnet::web {
namespace {

using namespace std::chrono_literals;
using Answer = HandHold::Answer;

constexpr base::TimePoint start{100s};
const HandMessage place{HandPlace{{0.01, 0.0, -0.02}}};
const HandMessage nothing{};

std::optional<HandMessage> read(const std::string& text)
{
    const auto json = control::parse_object(text);
    return json ? hand_message_in(*json) : std::nullopt;
}

TEST(WebHand, TakesAPlaceOrNothingAndNoOtherMessage)
{
    const auto read_place = read(R"({"hand":{"x":0.01,"y":0,"z":-0.25}})");
    ASSERT_TRUE(read_place && read_place->place);
    EXPECT_EQ(read_place->place->at[2], -0.25);
    EXPECT_FALSE(read_place->place->grips);
    const auto gripping = read(R"({"hand":{"x":0,"y":0,"z":0,"grip":true}})");
    ASSERT_TRUE(gripping && gripping->place);
    EXPECT_TRUE(gripping->place->grips);
    const auto released = read(R"({"hand":null})");
    ASSERT_TRUE(released);
    EXPECT_FALSE(released->place);
    for (const char* bad :
         {R"({"hand":{"x":0.01,"y":0}})", R"({"hand":{"x":0.01,"y":0,"z":0,"w":0}})",
          R"({"hand":{"x":"0","y":0,"z":0}})", R"({"hand":{"x":0.26,"y":0,"z":0}})",
          R"({"hand":{"x":0,"y":-1e300,"z":0}})", R"({"hand":{"x":1e999,"y":0,"z":0}})",
          R"({"hand":{"x":NaN,"y":0,"z":0}})", R"({"hand":{"x":null,"y":0,"z":0}})",
          R"({"hand":{"x":0,"y":0,"z":0,"grip":1}})", R"({"hand":{"x":0,"y":0,"grip":true}})",
          R"({"hand":[0,0,0]})", R"({"hand":true})", R"({"hand":{}})", R"({"ack":1})",
          R"({"hand":null,"peer":2})", R"({"hand":null,"command":"estop"})"}) {
        EXPECT_FALSE(read(bad)) << bad;
    }
}

TEST(WebHand, HasTheLimitsOfTheDeviceThatItMoves)
{
    EXPECT_EQ(hand_reach_m, device::page_reach_m);
    EXPECT_EQ(HandHold::lets_go_after, device::PageHand::lets_go_after);
}

TEST(WebHand, IsHeldByOnePageAndOthersWatch)
{
    HandHold hold;
    EXPECT_FALSE(hold.is_held(start));
    EXPECT_EQ(hold.on_message(1, place, start), Answer::taken);
    EXPECT_TRUE(hold.is_held(start));
    EXPECT_EQ(hold.on_message(2, place, start + 5ms), Answer::watches);
    EXPECT_EQ(hold.on_message(2, nothing, start + 6ms), Answer::watches);
    EXPECT_EQ(hold.on_message(1, place, start + 20ms), Answer::moved);
    EXPECT_NE(told_of(Answer::watches).find("another page holds the hand"), std::string::npos);
}

TEST(WebHand, IsFreeOnceItsPageLetsGoOrIsSilentFor250Milliseconds)
{
    HandHold hold;
    EXPECT_EQ(hold.on_message(1, place, start), Answer::taken);
    EXPECT_EQ(hold.on_message(1, nothing, start + 10ms), Answer::let_go);
    EXPECT_EQ(hold.on_message(2, place, start + 20ms), Answer::taken);
    EXPECT_EQ(hold.on_message(1, place, start + 270ms), Answer::watches);
    EXPECT_FALSE(hold.is_held(start + 270ms + 1ns));
    EXPECT_EQ(hold.on_message(1, place, start + 270ms + 1ns), Answer::taken);
}

TEST(WebHand, LeavesOutPlacesThatComeTooOften)
{
    HandHold hold;
    int counted = 0;
    for (base::Duration at{0}; at < 1s; at += 100us) {
        // Alternating with releases, and from several pages: no place is accepted more often.
        if (at.count() % 3 == 0) static_cast<void>(hold.on_message(1, nothing, start + at));
        const auto answer = hold.on_message(at.count() % 2 == 0 ? 1 : 2, place, start + at);
        if (answer == Answer::moved || answer == Answer::taken) ++counted;
    }
    EXPECT_LE(counted, 250);
    EXPECT_GE(counted, 100);
}

TEST(WebHand, AsksThePeerForAPlaceOrToLetGoAndNothingElse)
{
    EXPECT_EQ(hand_request(HandPlace{{0.01, 0.0, -0.25}, true}),
              R"({"command":"hand","x":0.01,"y":0.0,"z":-0.25,"grip":true})");
    EXPECT_EQ(hand_request(std::nullopt), R"({"command":"hand","let_go":true})");
}

} // namespace
} // namespace hapnet::web

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/send_policy.hpp"
#include "tests/unit/peer/core/pair.hpp"

#include <array>
#include <chrono>
#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

SendPolicy policy(std::string_view text) { return parse_send_policy(text).value(); }

TEST(SendPolicy, ReadsWhatItPrints)
{
    EXPECT_EQ(policy("every:1"), SendPolicy{});
    for (const std::string text : {"every:1", "every:10", "every:50", "deadband:0%", "deadband:8%",
                                   "deadband:12.5%,100ms", "deadband:100%,1ms"})
        EXPECT_EQ(text_of(policy(text)), text);
    EXPECT_EQ(text_of(policy("deadband:8%,50ms")), "deadband:8%");
}

TEST(SendPolicy, AnswersWhatItIsNotWithWhatToWrite)
{
    for (const std::string text :
         {"", "10", "every", "every:", "every:0", "every:51", "every:-1", "every:1.5",
          "deadband:", "deadband:8", "deadband:101%", "deadband:8%,", "deadband:8%,0ms",
          "deadband:8%,101ms", "deadband:8%,50ms,1", "Every:1"}) {
        const auto wrong = parse_send_policy(text);
        ASSERT_FALSE(wrong) << text;
        EXPECT_NE(wrong.error().message.find('\'' + text + '\''), std::string::npos);
    }
    EXPECT_NE(parse_send_policy("often").error().message.find("write every:N"), std::string::npos);
}

/// A hand at 1 mm steps of time, as a gate sees it.
struct Moving {
    SendGate gate;
    wire::State state{};
    std::int64_t tick = -1;

    explicit Moving(std::string_view text) : gate{policy(text)} {}

    SendCause next()
    {
        ++tick;
        state.sent = base::TimePoint{1s + tick * 1ms};
        return gate.judge(state, tick);
    }
};

TEST(SendGate, SendsEveryNthTick)
{
    Moving all{"every:1"};
    Moving tenth{"every:10"};
    for (int tick = 0; tick < 100; ++tick) {
        EXPECT_EQ(all.next(), SendCause::rate);
        EXPECT_EQ(tenth.next(), tick % 10 == 0 ? SendCause::rate : SendCause::held_back) << tick;
    }
}

TEST(SendGate, SaysNothingOfAHandThatGoesOnAsItDid)
{
    Moving hand{"deadband:8%"};
    hand.state.hip_velocity = {{0.2, 0.0, 0.0}};
    hand.state.contact_force = {{1.0, 0.0, 0.0}};
    for (int tick = 0; tick < 200; ++tick) {
        hand.state.hip = {{0.2e-3 * tick, 0.0, 0.0}};
        // Except the first state, and those after 50 ms of silence.
        EXPECT_EQ(hand.next(), tick % 50 == 0 ? SendCause::silence : SendCause::held_back) << tick;
    }
}

TEST(SendGate, SaysWhatThePredictionMisses)
{
    struct Case {
        SendCause cause;
        wire::State enough;
        wire::State too_little;
    };
    const auto at = [](double hip_m, double velocity_m_per_s, double force_n, bool touching) {
        wire::State state;
        state.hip = {{hip_m, 0.0, 0.0}};
        state.hip_velocity = {{velocity_m_per_s, 0.0, 0.0}};
        state.contact_force = {{0.0, force_n, 0.0}};
        state.touching = touching;
        return state;
    };
    // After 1 ms of 0.1 m/s and 1 N: the hand is expected 0.1 mm further. 8 % of 0.1 m/s is 8 mm/s,
    // and 8 % of 1 N is 80 mN; the least deadband of a distance is 0.1 mm.
    const std::array cases{
        Case{SendCause::contact, at(0.1e-3, 0.1, 1.0, true), at(0.1e-3, 0.1, 1.0, false)},
        Case{SendCause::force, at(0.1e-3, 0.1, 1.081, false), at(0.1e-3, 0.1, 1.079, false)},
        Case{SendCause::velocity, at(0.1e-3, 0.1081, 1.0, false), at(0.1e-3, 0.1079, 1.0, false)},
        Case{SendCause::position, at(0.201e-3, 0.1, 1.0, false), at(0.199e-3, 0.1, 1.0, false)},
    };
    for (const Case& one : cases) {
        for (const bool is_enough : {true, false}) {
            Moving hand{"deadband:8%"};
            hand.state = at(0.0, 0.1, 1.0, false);
            EXPECT_EQ(hand.next(), SendCause::silence);
            hand.state = is_enough ? one.enough : one.too_little;
            EXPECT_EQ(hand.next(), is_enough ? one.cause : SendCause::held_back)
                << base::name_of(one.cause);
        }
    }
}

TEST(SendGate, HasFloorsForSmallSignals)
{
    Moving hand{"deadband:8%"};
    EXPECT_EQ(hand.next(), SendCause::silence);
    hand.state.hip_velocity = {{4.9e-3, 0.0, 0.0}};
    hand.state.contact_force = {{0.019, 0.0, 0.0}};
    hand.state.hip = {{0.099e-3, 0.0, 0.0}};
    EXPECT_EQ(hand.next(), SendCause::held_back);
    hand.state.hip_velocity = {{5.1e-3, 0.0, 0.0}};
    EXPECT_EQ(hand.next(), SendCause::velocity);
}

/// Two peers with this send policy.
Pair pair_that_sends(std::string_view text)
{
    Pair pair;
    for (const std::size_t side : {0U, 1U}) {
        Settings settings = settings_of(side);
        settings.send = policy(text);
        pair.start(side, settings);
    }
    return pair;
}

TEST(PeerThatSendsLess, NumbersItsMessagesAndCountsWhatItHoldsBack)
{
    Pair pair = pair_that_sends("every:10");
    pair.run_until_started();
    pair.hands[0] = pushing(0.004);
    const Counters before = pair.peers[0]->counters();
    pair.run_for(2s);
    const Counters& after = pair.peers[0]->counters();
    EXPECT_EQ(after.sent - before.sent, 200U);
    EXPECT_EQ(after.sending[SendCause::rate] - before.sending[SendCause::rate], 200U);
    EXPECT_EQ(after.sending[SendCause::held_back] - before.sending[SendCause::held_back], 1800U);
    EXPECT_EQ(pair.peers[1]->counters().implausible, 0U);
    EXPECT_EQ(pair.peers[1]->counters().outdated, 0U);
    EXPECT_TRUE(pair.ticks[1].permitted);
    EXPECT_FALSE(pair.told(1, Event::lost));
}

TEST(PeerThatSendsLess, TellsOfBodiesThatRestWithinASecond)
{
    Pair pair = pair_that_sends("deadband:8%,100ms");
    pair.run_until_started();
    pair.run_for(2s); // until earlier motion was sent
    int bodies = 0;
    for (int ms = 0; ms < 1000; ++ms) {
        pair.step();
        for (const wire::Message& message : pair.sent[0]) {
            const auto* const state = std::get_if<wire::State>(&message);
            if (state != nullptr && !state->bodies.empty()) ++bodies;
        }
    }
    EXPECT_GE(bodies, 9);
}

} // namespace
} // namespace hapnet::peer

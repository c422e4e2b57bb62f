// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/handshake.hpp"

#include "tests/unit/peer/core/meeting.hpp"

#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

constexpr Path prompt{};
constexpr Path far{.delay_min = 160ms, .delay_max = 160ms};

wire::Hello hello_of(const Introduction& self, std::uint32_t nonce_heard = 0)
{
    Handshake handshake{self};
    wire::Hello hello = handshake.hello(base::TimePoint{1h}, 0).value();
    hello.nonce_heard = nonce_heard;
    return hello;
}

TEST(Handshake, SaysHelloEvery20MsUntilItIsAnswered)
{
    Meeting meeting{prompt};
    meeting.kill(1);
    meeting.run_for(10s);
    EXPECT_EQ(meeting.hellos[0], 500);
    EXPECT_FALSE(meeting.sides[0]->session());
    EXPECT_FALSE(meeting.sides[0]->has_met());
}

TEST(Handshake, StartsOneSecondAfterTheLowerIdLearnsThatItWasHeard)
{
    Meeting meeting{far};
    while (!meeting.sides[0]->session()) meeting.step();
    EXPECT_EQ(meeting.sides[0]->session()->start, meeting.now + 1s);
    EXPECT_FALSE(meeting.sides[1]->session());
    meeting.run_for(180ms); // the next hello, and its way
    ASSERT_TRUE(meeting.agree());
    EXPECT_EQ(meeting.start_error(), 0ns);
}

TEST(Handshake, TakesSeedAndRolesFromTheLowerId)
{
    Meeting meeting{far};
    meeting.run_for(2s);
    ASSERT_TRUE(meeting.agree());
    EXPECT_EQ(meeting.sides[0]->session()->seed, introduction(0, 1).seed);
    EXPECT_NE(meeting.sides[0]->session()->number, 0U);
    EXPECT_FALSE(meeting.sides[0]->session()->joined_late);
    EXPECT_FALSE(meeting.sides[1]->session()->joined_late);
}

TEST(Handshake, ConvertsTheStartBetweenClocksThatDiffer)
{
    for (const base::Duration ahead :
         {base::Duration{1ns}, base::Duration{26h}, -base::Duration{59min}}) {
        Meeting meeting{far};
        meeting.ahead[1] = ahead;
        meeting.run_for(2s);
        ASSERT_TRUE(meeting.agree());
        EXPECT_LE(meeting.start_error(), 1ns) << ahead.count();
        ASSERT_TRUE(meeting.sides[0]->clock());
        EXPECT_LE(std::chrono::abs(meeting.sides[0]->clock()->offset - ahead), 1ns);
        EXPECT_EQ(meeting.sides[0]->clock()->uncertainty, 160ms);
    }
}

TEST(Handshake, ConvertsTheStartWhereClocksDifferAlthoughBothSidesNameTheSameBoot)
{
    for (const base::Duration ahead :
         {base::Duration{0}, base::Duration{26h}, -base::Duration{2s}, base::Duration{40 * 24h}}) {
        Meeting meeting{far};
        meeting.boot = 5; // two time namespaces, or two virtual machines of one snapshot
        for (const std::size_t side : {0U, 1U}) meeting.restart(side);
        meeting.ahead[1] = ahead;
        meeting.run_for(2s);
        ASSERT_TRUE(meeting.agree()) << ahead.count();
        EXPECT_LE(meeting.start_error(), 1ns) << ahead.count();
        const bool is_one = ahead == base::Duration{0};
        EXPECT_EQ(meeting.sides[1]->clock()->offset, -ahead);
        EXPECT_EQ(meeting.sides[1]->clock()->uncertainty, is_one ? 0ms : 160ms);
    }
}

TEST(Handshake, IsSilentOnceBothKnowTheStart)
{
    Meeting meeting{far};
    meeting.run_for(3s);
    ASSERT_TRUE(meeting.agree());
    meeting.hellos = {};
    meeting.run_for(60s);
    EXPECT_EQ(meeting.hellos, (std::array<int, 2>{0, 0}));
}

TEST(Handshake, LetsTheOtherComeLongAfterwards)
{
    Meeting meeting{far};
    meeting.kill(0);
    meeting.run_for(60s);
    meeting.restart(0);
    const base::TimePoint came = meeting.now;
    meeting.run_for(3s);
    ASSERT_TRUE(meeting.agree());
    EXPECT_GE(meeting.sides[0]->session()->start, came + 1s);
    EXPECT_LE(meeting.sides[0]->session()->start, came + 2s);
    EXPECT_FALSE(meeting.sides[0]->session()->joined_late);
}

class Restart : public testing::TestWithParam<std::size_t> {};

TEST_P(Restart, OfEitherSideJoinsTheSessionUnderWay)
{
    const std::size_t restarted = GetParam();
    const std::size_t stayed = 1 - restarted;
    Meeting meeting{far};
    meeting.ahead[1] = 5s;
    meeting.run_for(5s);
    ASSERT_TRUE(meeting.agree());
    const Session before = *meeting.sides[stayed]->session();
    meeting.kill(restarted);
    meeting.run_for(2s);
    meeting.restart(restarted);
    meeting.run_for(3s);

    ASSERT_TRUE(meeting.agree());
    EXPECT_EQ(meeting.sides[stayed]->session()->start, before.start);
    EXPECT_EQ(meeting.sides[stayed]->session()->seed, before.seed);
    EXPECT_NE(meeting.sides[stayed]->session()->number, before.number);
    EXPECT_LE(meeting.start_error(), 1ns);
    EXPECT_TRUE(meeting.sides[restarted]->session()->joined_late);
    EXPECT_FALSE(meeting.sides[stayed]->session()->joined_late);
    meeting.hellos = {};
    meeting.run_for(10s);
    EXPECT_EQ(meeting.hellos, (std::array<int, 2>{0, 0}));
}

TEST_P(Restart, OfTheOtherSideAfterwardsJoinsItToo)
{
    const std::size_t first = GetParam();
    Meeting meeting{far};
    meeting.run_for(3s);
    ASSERT_TRUE(meeting.agree());
    const base::TimePoint start = meeting.sides[first]->session()->start;
    for (const std::size_t side : {first, 1 - first, first}) {
        meeting.restart(side);
        meeting.run_for(3s);
        ASSERT_TRUE(meeting.agree()) << side;
        EXPECT_EQ(meeting.sides[side]->session()->start, start);
        EXPECT_TRUE(meeting.sides[side]->session()->joined_late);
        EXPECT_FALSE(meeting.sides[1 - side]->session()->joined_late);
    }
    meeting.hellos = {};
    meeting.run_for(10s);
    EXPECT_EQ(meeting.hellos, (std::array<int, 2>{0, 0}));
}

INSTANTIATE_TEST_SUITE_P(Side, Restart, testing::Values(0, 1));

TEST(Handshake, RecoversFromALateHelloOfAnEarlierRun)
{
    for (const std::size_t hearer : {0U, 1U}) {
        Meeting meeting{far};
        meeting.run_for(3s);
        ASSERT_TRUE(meeting.agree());
        const auto number = meeting.sides[hearer]->session()->number;
        const auto late = hello_of(introduction(1 - hearer, 99));
        EXPECT_FALSE(meeting.sides[hearer]->on_hello(late, meeting.clock(hearer)));
        EXPECT_FALSE(meeting.agree());
        meeting.run_for(2s);
        EXPECT_TRUE(meeting.agree());
        EXPECT_EQ(meeting.sides[hearer]->session()->number, number);
        meeting.hellos = {};
        meeting.run_for(10s);
        EXPECT_EQ(meeting.hellos, (std::array<int, 2>{0, 0})) << hearer;
    }
}

TEST(Handshake, RefusesWhoeverPlaysSomethingElse)
{
    const auto objection = [](auto change) {
        Introduction other = introduction(1);
        change(other);
        Handshake handshake{introduction(0)};
        const auto reason = handshake.on_hello(hello_of(other), base::TimePoint{1h});
        EXPECT_EQ(handshake.has_met(), !reason.has_value());
        return reason;
    };
    using wire::ByeReason;
    EXPECT_EQ(objection([](Introduction&) {}), std::nullopt);
    EXPECT_EQ(objection([](Introduction& i) { i.id = 1; }), ByeReason::same_id);
    EXPECT_EQ(objection([](Introduction& i) { i.scene_hash = 1; }), ByeReason::other_scene);
    EXPECT_EQ(objection([](Introduction& i) { i.task = wire::TaskName::from_text("P1").value(); }),
              ByeReason::other_task);
    EXPECT_EQ(objection([](Introduction& i) { i.tick_rate_hz = 500; }), ByeReason::other_tick_rate);
}

TEST(Handshake, IgnoresItsOwnHelloWhenSomebodySendsItBack)
{
    Handshake handshake{introduction(0)};
    const auto own = handshake.hello(base::TimePoint{1h}, 0);
    ASSERT_TRUE(own);
    EXPECT_EQ(handshake.on_hello(*own, base::TimePoint{1h} + 1ms), std::nullopt);
    EXPECT_FALSE(handshake.has_met());
}

TEST(Handshake, DoesNotBelieveAStartThatNoSessionCanHave)
{
    for (const base::Duration away : {base::Duration{300h}, base::Duration{-300h}}) {
        Handshake handshake{introduction(1)};
        const base::TimePoint now{1000h};
        wire::Hello hello = hello_of(introduction(0), introduction(1).nonce);
        hello.sent = now;
        hello.echo = wire::Echo{now, 0ns};
        hello.start = now + away;
        EXPECT_FALSE(handshake.on_hello(hello, now));
        EXPECT_FALSE(handshake.session());
        hello.start = now - 200h; // long, but allowed by the options
        EXPECT_FALSE(handshake.on_hello(hello, now));
        EXPECT_TRUE(handshake.session());
    }
}

TEST(Handshake, GetsOverADamagedStartBeforeTheSessionAndMovesNoneAfterwards)
{
    Handshake handshake{introduction(1)};
    base::TimePoint now{1000h};
    wire::Hello hello = hello_of(introduction(0), introduction(1).nonce);
    const auto hear = [&](base::TimePoint start) {
        now += 20ms;
        hello.sent = now;
        hello.echo = wire::Echo{now, 0ns};
        hello.start = start;
        EXPECT_FALSE(handshake.on_hello(hello, now));
        return handshake.session()->start;
    };
    const base::TimePoint damaged = now + 100h;
    const base::TimePoint true_start = now + 1s;
    EXPECT_EQ(hear(damaged), damaged);
    EXPECT_EQ(hear(true_start), damaged);
    EXPECT_EQ(hear(true_start), damaged);
    EXPECT_EQ(hear(true_start), true_start);
    EXPECT_EQ(hear(damaged), true_start);
    now = true_start;
    for (int i = 0; i < 10; ++i) EXPECT_EQ(hear(damaged), true_start);
}

TEST(Handshake, DoesNotBelieveAnotherRunWhileTheOneThatItKnowsIsHeard)
{
    Meeting meeting{prompt};
    meeting.run_for(3s);
    ASSERT_TRUE(meeting.agree());
    Handshake& handshake = *meeting.sides[0];
    const auto number = handshake.session()->number;
    const auto other = hello_of(introduction(1, 99));
    EXPECT_FALSE(handshake.on_hello(other, meeting.clock(0), Handshake::Known::heard));
    EXPECT_EQ(handshake.session()->number, number);
    EXPECT_FALSE(handshake.on_hello(other, meeting.clock(0), Handshake::Known::silent));
    EXPECT_NE(handshake.session()->number, number);
}

TEST(Handshake, EchoesTheNewestMessageWithItsAgeUpToWhatTheWireHolds)
{
    Handshake handshake{introduction(0)};
    const base::TimePoint now{1h};
    EXPECT_FALSE(handshake.echo(now));
    handshake.on_echo(std::nullopt, now + 7h, now); // sent, on their clock
    handshake.on_echo(std::nullopt, now + 6h, now + 5ms);
    EXPECT_EQ(handshake.echo(now + 10ms), (wire::Echo{now + 7h, 10ms}));
    EXPECT_TRUE(handshake.echo(now + base::Duration{0xffffffff}));
    EXPECT_FALSE(handshake.echo(now + base::Duration{0x100000000}));
    EXPECT_FALSE(handshake.echo(now - 1ns));
}

TEST(Handshake, EchoesWhatComesAfterAClockHasJumpedOnceNothingWasNewestForASecond)
{
    for (const base::Duration jump : {base::Duration{7h}, base::Duration{-7h}}) {
        Handshake handshake{introduction(0)};
        const base::TimePoint now{10h};
        handshake.on_echo(std::nullopt, now, now);
        handshake.on_echo(std::nullopt, now + 1s + jump, now + 1s);
        EXPECT_EQ(handshake.echo(now + 1s), (wire::Echo{now, 1s}));
        handshake.on_echo(std::nullopt, now + 1001ms + jump, now + 1001ms);
        EXPECT_EQ(handshake.echo(now + 1001ms), (wire::Echo{now + 1001ms + jump, 0ms}));
    }
}

TEST(Handshake, TellsNoClockWhileItIsInDoubt)
{
    Handshake handshake{introduction(0)};
    const base::TimePoint now{10h};
    const auto hear = [&](base::Duration at, base::Duration ahead) {
        handshake.on_echo(wire::Echo{now + at - 40ms, {}}, now + at - 20ms + ahead, now + at);
    };
    for (base::Duration at{0}; at < 3s; at += 10ms) hear(at, 7h);
    ASSERT_TRUE(handshake.clock());
    EXPECT_EQ(handshake.clock()->offset, 7h);
    hear(3s, 7h + 71ms); // half the round trip and 50 ms are 70 ms
    EXPECT_FALSE(handshake.clock());
    EXPECT_TRUE(handshake.clock_sync().estimate());
    for (int i = 0; i < 8; ++i) {
        EXPECT_FALSE(handshake.clock()) << i;
        hear(3001ms + i * 1ms, 7h);
    }
    EXPECT_TRUE(handshake.clock());
}

} // namespace
} // namespace hapnet::peer

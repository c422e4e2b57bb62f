// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The life of a session, as one of its peers tells it.
#include "tests/unit/peer/core/pair.hpp"

namespace hapnet::peer {
namespace {

TEST(PeerSession, GoesThroughItsPhasesAndTellsOfThem)
{
    Pair pair;
    EXPECT_EQ(pair.peers[0]->hands_on(), 17s);
    pair.step();
    EXPECT_EQ(pair.ticks[0].phase, Phase::waiting);
    pair.run_for(500ms);
    EXPECT_EQ(pair.ticks[0].phase, Phase::countdown);
    EXPECT_EQ(pair.ticks[0].sequence, 0U); // no states before the start
    pair.run_until_started();
    pair.run_for(17s);
    EXPECT_EQ(pair.ticks[0].phase, Phase::hands_off);
    pair.run_for(3s);
    EXPECT_EQ(pair.ticks[0].phase, Phase::ended);
    pair.run_for(100ms);
    for (const std::size_t side : {0U, 1U}) {
        EXPECT_TRUE(pair.peers[side]->finished());
        const std::vector<Event> expected{Event::met, Event::agreed, Event::started,
                                          Event::hands_off, Event::ended};
        EXPECT_EQ(pair.events[side], expected) << side;
    }
}

TEST(PeerSession, OfLessThanSixSecondsIsHandsOffForHalfOfIt)
{
    Settings settings = settings_of(0);
    settings.length = 4s;
    EXPECT_EQ(Peer{settings}.hands_on(), 2s);
}

TEST(PeerSession, SaysGoodbyeFiveTimesAndIsThenFinished)
{
    Pair pair;
    pair.run_until_started();
    pair.peers[0]->leave(wire::ByeReason::interrupted);
    int byes = 0;
    for (int ms = 0; ms < 100; ++ms) {
        pair.step();
        for (const wire::Message& message : pair.sent[0]) {
            ASSERT_TRUE(std::holds_alternative<wire::Bye>(message));
            EXPECT_EQ(std::get<wire::Bye>(message).reason, wire::ByeReason::interrupted);
            EXPECT_EQ(std::get<wire::Bye>(message).session, pair.peers[1]->session()->number);
            ++byes;
        }
        EXPECT_EQ(pair.ticks[0].force, base::Force{});
        EXPECT_FALSE(pair.ticks[0].permitted);
    }
    EXPECT_EQ(byes, Peer::byes);
    EXPECT_TRUE(pair.peers[0]->finished());
}

TEST(PeerSession, GoesOnAloneWithoutForceOrMessagesAfterAGoodbye)
{
    Pair pair;
    pair.run_until_started();
    pair.hands[1] = pushing(0.004);
    pair.run_for(10ms);
    EXPECT_TRUE(pair.ticks[1].permitted);
    pair.peers[0]->leave(wire::ByeReason::finished);
    pair.run_for(50ms);
    EXPECT_TRUE(pair.peers[1]->is_alone());
    EXPECT_TRUE(pair.told(1, Event::left));
    EXPECT_FALSE(pair.told(1, Event::lost)); // it went; it did not fall silent
    EXPECT_FALSE(pair.ticks[1].permitted);
    EXPECT_FALSE(pair.ticks[1].remote_touching);
    EXPECT_EQ(pair.ticks[1].sequence, 0U);
    pair.run_for(25s);
    EXPECT_TRUE(pair.peers[1]->finished());
    EXPECT_FALSE(pair.told(1, Event::lost));
}

TEST(PeerSession, LeavesWithoutAWordWhenNobodyHasAnswered)
{
    Pair pair;
    pair.kill(1);
    pair.run_for(1s);
    pair.peers[0]->leave(wire::ByeReason::interrupted);
    EXPECT_TRUE(pair.peers[0]->finished());
}

TEST(PeerSession, TellsOfSilenceAfter300MsAndOfItsEnd)
{
    Pair pair;
    pair.run_until_started();
    pair.cut = true;
    pair.run_for(299ms);
    EXPECT_FALSE(pair.told(0, Event::lost));
    pair.run_for(3ms);
    EXPECT_TRUE(pair.told(0, Event::lost));
    EXPECT_FALSE(pair.told(0, Event::back));
    pair.cut = false;
    pair.run_for(5ms);
    EXPECT_TRUE(pair.told(0, Event::back));
    EXPECT_EQ(std::count(pair.events[0].begin(), pair.events[0].end(), Event::lost), 1);
}

TEST(PeerSession, TellsOfSilenceToOneThatHasNotHeardASingleStateASecondAfterItsStart)
{
    Pair pair;
    while (pair.ticks[0].phase != Phase::countdown) pair.step();
    pair.run_for(500ms);
    pair.cut = true;
    while (pair.ticks[0].phase != Phase::running) pair.step();
    pair.run_for(999ms);
    EXPECT_FALSE(pair.told(0, Event::lost));
    pair.run_for(1ms);
    EXPECT_TRUE(pair.told(0, Event::lost));
    pair.cut = false;
    pair.run_for(5ms);
    EXPECT_TRUE(pair.told(0, Event::back));
}

TEST(PeerSession, PermitsForceOnlyWhileTheOtherSideIsFresh)
{
    Pair pair;
    pair.run_until_started();
    pair.run_for(10ms);
    EXPECT_TRUE(pair.ticks[0].permitted);
    pair.cut = true;
    pair.step(); // the last words arrive
    pair.run_for(250ms);
    EXPECT_TRUE(pair.ticks[0].permitted);
    pair.step();
    EXPECT_FALSE(pair.ticks[0].permitted); // the governor's 50 ms begin: zero at 300 ms
}

TEST(PeerSession, RefusesAndIsRefusedWithTheSameReason)
{
    Pair pair;
    Settings other = settings_of(1);
    other.introduction.task = wire::TaskName::from_text("P1").value();
    pair.start(1, other);
    pair.run_for(100ms);
    for (const std::size_t side : {0U, 1U}) {
        EXPECT_EQ(pair.peers[side]->refusal(), wire::ByeReason::other_task) << side;
        EXPECT_TRUE(pair.peers[side]->finished()) << side;
        EXPECT_EQ(pair.events[side], std::vector<Event>{Event::refused}) << side;
    }
}

TEST(PeerSession, RefusesAnotherVersionOfTheProtocolWhenItHasHeardItThrice)
{
    Peer peer{settings_of(1, 50)};
    const base::TimePoint now{std::chrono::hours{1}};
    const std::array<std::byte, 4> newer{std::byte{'H'}, std::byte{'N'}, std::byte{2},
                                         std::byte{9}};
    for (const auto at : {0ms, 1ms, 20ms}) peer.on_datagram(newer, now + at); // 1 ms is the same
    EXPECT_FALSE(peer.refusal());
    peer.on_datagram(newer, now + 40ms);
    EXPECT_EQ(peer.refusal(), wire::ByeReason::other_version);
    EXPECT_EQ(peer.counters().other_version, 4U);
}

TEST(PeerSession, IsNotRefusedForDamagedHellosBetweenGoodOnes)
{
    Pair pair;
    Settings damaged = settings_of(2, 51);
    damaged.introduction.scene_hash ^= 1;
    Peer stranger{damaged};
    for (int i = 0; i < 50 && pair.peers[0]->counters().hellos < 20; ++i) {
        std::ignore = stranger.tick(pair.now, {});
        if (const auto hello = stranger.poll()) {
            pair.peers[0]->on_datagram(hello->bytes(), pair.now);
        }
        for (int ms = 0; ms < 20; ++ms) pair.step();
    }
    EXPECT_FALSE(pair.peers[0]->refusal());
}

TEST(PeerSession, DoesNotBelieveASequenceThatCannotBeYet)
{
    Pair pair;
    pair.run_until_started();
    wire::State wild;
    wild.session = pair.peers[0]->session()->number;
    wild.sequence = 1U << 30;
    wild.sent = pair.now;
    pair.peers[0]->on_datagram(wire::encode(wild).bytes(), pair.now);
    EXPECT_EQ(pair.peers[0]->counters().implausible, 1U);
    const auto taken = pair.peers[0]->counters().states;
    for (int ms = 0; ms < 100; ++ms) pair.step();
    EXPECT_GT(pair.peers[0]->counters().states, taken + 50);
}

TEST(PeerSession, UnderWayIsNotEndedByAStrangeHelloVersionOrRefusal)
{
    Pair pair;
    pair.run_until_started();
    Settings strange = settings_of(1, 50);
    strange.introduction.scene_hash = 1;
    Peer stranger{strange};
    std::ignore = stranger.tick(pair.now, {});
    pair.peers[0]->on_datagram(stranger.poll().value().bytes(), pair.now);
    pair.peers[0]->on_datagram(wire::encode(wire::Bye{0, wire::ByeReason::other_task}).bytes(),
                               pair.now);
    const std::array<std::byte, 3> newer{std::byte{'H'}, std::byte{'N'}, std::byte{2}};
    pair.peers[0]->on_datagram(newer, pair.now);
    pair.step();
    EXPECT_FALSE(pair.peers[0]->refusal());
    EXPECT_EQ(pair.ticks[0].phase, Phase::running);
    const auto* bye = std::get_if<wire::Bye>(&pair.sent[0].front());
    ASSERT_NE(bye, nullptr); // but the stranger is told
    EXPECT_EQ(*bye, (wire::Bye{0, wire::ByeReason::other_scene}));
}

TEST(PeerSession, ResumesWithARestartedSideThatTakesTheCubeFromTheOneThatStayed)
{
    for (const std::size_t restarted : {0U, 1U}) {
        const std::size_t stayed = 1 - restarted;
        Pair pair;
        pair.run_until_started();
        pair.hands[0] = pushing(0.004);
        pair.run_for(500ms); // the cube goes right
        pair.hands[0] = {.hip = {{-0.05, 0.0, 0.0}}, .velocity = {}};
        pair.run_for(1s);
        const base::Position was = pair.peers[stayed]->body().position;
        EXPECT_GT(was.x(), 0.003);
        pair.kill(restarted);
        pair.run_for(1s);
        EXPECT_TRUE(pair.told(stayed, Event::lost));
        pair.events = {};
        pair.start(restarted, settings_of(restarted, 1));
        pair.run_for(200ms);
        EXPECT_TRUE(pair.told(stayed, Event::restarted));
        EXPECT_TRUE(pair.told(restarted, Event::joined));
        EXPECT_NEAR(pair.peers[restarted]->body().position.x(), was.x(), 1e-8);
        EXPECT_EQ(pair.peers[stayed]->body().position.x(), was.x());
        EXPECT_TRUE(pair.ticks[stayed].permitted);
        EXPECT_TRUE(pair.ticks[restarted].permitted);
        EXPECT_EQ(pair.peers[0]->session()->start, pair.peers[1]->session()->start);
    }
}

TEST(PeerSession, CountsOnWhenALateHelloOfAnEarlierRunMadeItChangeOverAndBack)
{
    Pair pair;
    pair.run_until_started();
    pair.run_for(2s);
    const std::uint32_t sequence = pair.ticks[0].sequence;
    Peer earlier{settings_of(1, 50)};
    std::ignore = earlier.tick(pair.now, {});
    pair.peers[0]->on_datagram(earlier.poll().value().bytes(), pair.now);
    pair.run_for(500ms);
    EXPECT_EQ(pair.peers[0]->session()->number, pair.peers[1]->session()->number);
    EXPECT_GT(pair.ticks[0].sequence, sequence);
    EXPECT_EQ(pair.ticks[0].freshness, 1.0);
    EXPECT_EQ(pair.ticks[1].freshness, 1.0);
}

} // namespace
} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// An attacker on the path, who sees one side's messages and can send in its name, against sessions
// without keys: the effects of single forged datagrams.
#include "device/governor.hpp"
#include "tests/unit/peer/core/pair.hpp"

namespace hapnet::peer {
namespace {

/// A running session in which side 0 presses the cube.
Pair playing()
{
    Pair pair;
    pair.run_until_started();
    pair.hands[0] = pushing(0.003);
    pair.run_for(500ms);
    return pair;
}

/// A hello in the name of a side, which names the other's run.
wire::Hello forged_hello(const Pair& pair, std::size_t in_the_name_of)
{
    const Introduction self = settings_of(in_the_name_of).introduction;
    wire::Hello hello;
    hello.nonce = self.nonce;
    hello.nonce_heard = settings_of(1 - in_the_name_of).introduction.nonce;
    hello.peer_id = self.id;
    hello.tick_rate_hz = self.tick_rate_hz;
    hello.scene_hash = self.scene_hash;
    hello.task = self.task;
    hello.sent = pair.now;
    hello.echo = wire::Echo{pair.now, 0ns};
    return hello;
}

void give(Pair& pair, std::size_t victim, const wire::Message& message)
{
    pair.peers[victim]->on_datagram(wire::encode(message).bytes(), pair.now);
}

/// Expects that both continue in the same session, and that every state counts.
void expect_to_play_on(Pair& pair, const Session& before, std::size_t victim)
{
    const Counters counted = pair.peers[victim]->counters();
    pair.run_for(1s);
    const Counters& now = pair.peers[victim]->counters();
    EXPECT_EQ(pair.peers[victim]->session()->start, before.start);
    EXPECT_EQ(pair.peers[victim]->session()->number, before.number);
    EXPECT_EQ(pair.ticks[victim].phase, Phase::running);
    EXPECT_TRUE(pair.ticks[victim].permitted);
    EXPECT_EQ(now.states - counted.states, 1000U);
    EXPECT_EQ(now.implausible, counted.implausible);
    EXPECT_EQ(now.outdated, counted.outdated);
    EXPECT_EQ(now.other_session, counted.other_session);
}

class Forged : public testing::TestWithParam<std::size_t> {};

TEST_P(Forged, StartDoesNotMoveASessionUnderWay)
{
    const std::size_t victim = GetParam();
    for (const base::Duration away : {base::Duration{-1h}, base::Duration{1500ms}}) {
        Pair pair = playing();
        const Session before = *pair.peers[victim]->session();
        for (int i = 0; i < 10; ++i) {
            wire::Hello hello = forged_hello(pair, 1 - victim);
            hello.start = pair.now + away;
            hello.in_session = i % 2 == 0;
            give(pair, victim, hello);
            pair.run_for(20ms);
        }
        expect_to_play_on(pair, before, victim);
    }
}

TEST_P(Forged, HellosOfOtherRunsDoNotReplaceTheOneThatIsHeard)
{
    const std::size_t victim = GetParam();
    Pair pair = playing();
    const Session before = *pair.peers[victim]->session();
    for (std::uint32_t run = 0; run < 5000; ++run) { // in 3 s
        wire::Hello hello = forged_hello(pair, 1 - victim);
        hello.nonce = 50'000 + run % 2;
        give(pair, victim, hello);
        if (run % 2 == 0) pair.step();
    }
    EXPECT_FALSE(pair.told(victim, Event::restarted));
    expect_to_play_on(pair, before, victim);
}

TEST_P(Forged, GoodbyeIsTakenBackWhenTheOtherSideGoesOn)
{
    const std::size_t victim = GetParam();
    Pair pair = playing();
    pair.events = {};
    give(pair, victim, wire::Bye{pair.peers[victim]->session()->number, wire::ByeReason::finished});
    pair.step();
    EXPECT_FALSE(pair.ticks[victim].permitted); // when in doubt, no force
    EXPECT_TRUE(pair.told(victim, Event::left));
    pair.run_for(310ms);
    EXPECT_FALSE(pair.peers[victim]->is_alone());
    EXPECT_TRUE(pair.told(victim, Event::back));
    pair.run_for(300ms); // the other side has heard this one again
    for (const std::size_t side : {0U, 1U}) EXPECT_TRUE(pair.ticks[side].permitted) << side;
    expect_to_play_on(pair, *pair.peers[victim]->session(), victim);
}

TEST_P(Forged, NumbersAheadDoNotMakeTrueStatesOutdated)
{
    const std::size_t victim = GetParam();
    for (const base::Duration stamped_ahead : {base::Duration{0}, base::Duration{900ms}}) {
        Pair pair = playing();
        const auto refused_before = pair.peers[victim]->counters().implausible;
        for (int i = 0; i < 30; ++i) { // ten per second
            wire::State state = pair.state_sent_by(1 - victim).value();
            state.sequence += 900;
            state.sent += stamped_ahead;
            state.touching = true;
            state.contact_force = {{3.3, 0.0, 0.0}};
            give(pair, victim, state);
            EXPECT_NE(pair.ticks[victim].remote_force, state.contact_force);
            pair.run_for(100ms);
        }
        const Counters& counted = pair.peers[victim]->counters();
        EXPECT_EQ(counted.implausible - refused_before, 30U);
        EXPECT_EQ(counted.outdated, 0U);
        EXPECT_TRUE(pair.ticks[victim].permitted);
    }
}

TEST_P(Forged, PlacesDoNotDragTheBodyOutOfWhatTheOtherSideBelieves)
{
    const std::size_t victim = GetParam();
    Pair pair = playing();
    pair.hands = {};
    pair.cut = true; // only the forger is heard
    for (int ms = 0; ms < 400; ++ms) {
        wire::State state = pair.state_sent_by(1 - victim).value();
        wire::BodyState body;
        body.position = {{ms % 2 == 0 ? 0.9 : -0.9, 0.0, 0.0}};
        state.touching = true;
        state.bodies.clear();
        state.bodies.add(body);
        give(pair, victim, state);
        pair.step();
        ASSERT_LE(std::abs(pair.peers[victim]->position().x()), 1.0) << ms;
    }
    pair.cut = false;
    const auto refused_before = pair.peers[1 - victim]->counters().implausible;
    pair.run_for(1s);
    EXPECT_EQ(pair.peers[1 - victim]->counters().implausible, refused_before);
    EXPECT_TRUE(pair.ticks[1 - victim].permitted);
}

INSTANTIATE_TEST_SUITE_P(ToSide, Forged, testing::Values(0, 1));

TEST(Goodbye, StaysOneWhenOnlyStatesArriveThatItHasOvertaken)
{
    Pair pair = playing();
    std::vector<wire::State> overtaken;
    pair.cut = true; // a path of 2 s, on which the goodbye overtakes
    for (int ms = 0; ms < 250; ++ms) {
        pair.step();
        overtaken.push_back(pair.state_sent_by(1).value());
    }
    pair.kill(1);
    give(pair, 0, wire::Bye{pair.peers[0]->session()->number, wire::ByeReason::interrupted});
    for (const wire::State& state : overtaken) {
        pair.run_for(7ms);
        give(pair, 0, state);
    }
    EXPECT_TRUE(pair.peers[0]->is_alone());
    EXPECT_FALSE(pair.told(0, Event::back));
}

TEST(HandsOff, EndsTheForceWhateverTheOtherSideSends)
{
    Pair pair = playing();
    device::Governor governor{{}};
    device::Sample sample;
    int ticks_with_force = 0;
    base::Duration since_hands_off{};
    for (int ms = 0; ms < 19'000; ++ms) {
        // A hand that continues to press, wherever the cube goes.
        pair.hands[0].hip = {{pair.peers[0]->position().x() - 0.022, 0.0, 0.0}};
        pair.step();
        if (auto state = pair.state_sent_by(1)) { // pushes on, whatever the phase
            state->sequence += 1;
            state->touching = true;
            state->contact_force = {{-3.0, 0.0, 0.0}};
            give(pair, 0, *state);
        }
        ++sample.sequence;
        const base::Force force =
            governor.govern({pair.ticks[0].force, pair.ticks[0].permitted}, sample, pair.now)
                .force();
        if (pair.ticks[0].phase == Phase::running)
            ticks_with_force += force == base::Force{} ? 0 : 1;
        if (pair.ticks[0].phase != Phase::hands_off) continue;
        EXPECT_FALSE(pair.ticks[0].permitted);
        since_hands_off += 1ms;
        const bool has_faded = since_hands_off > 51ms;
        EXPECT_TRUE(!has_faded || force == base::Force{}) << ms;
    }
    EXPECT_GT(ticks_with_force, 1000);
    EXPECT_GT(since_hands_off, 1s);
}

TEST(ShortMessagesOnly, AreToldToAPersonASecondLater)
{
    Pair pair = playing();
    pair.cut = true;
    std::uint32_t ticks = 0;
    while (!pair.told(0, Event::no_body) && ++ticks < 5000) {
        pair.step();
        wire::State state = pair.state_sent_by(1).value();
        state.bodies.clear();
        give(pair, 0, state);
    }
    EXPECT_GE(ticks, 1000U);
    EXPECT_LE(ticks, 1100U);
    pair.cut = false;
    pair.run_for(5s);
    EXPECT_EQ(std::count(pair.events[0].begin(), pair.events[0].end(), Event::no_body), 1);
    EXPECT_FALSE(pair.told(1, Event::no_body));
}

} // namespace
} // namespace hapnet::peer

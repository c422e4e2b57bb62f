// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/peer/core/pair.hpp"

namespace hapnet::peer {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// The life of a session, as one of its peers reports it.

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
    EXPECT_EQ(byes, Farewell::byes);
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
    EXPECT_FALSE(pair.told(1, Event::lost)); // it left; it did not fall silent
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
    const std::array<std::byte, 4> newer{std::byte{'H'}, std::byte{'N'}, std::byte{3},
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
    pair.peers[0]->on_datagram(stranger.poll()->bytes(), pair.now);
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
    pair.peers[0]->on_datagram(earlier.poll()->bytes(), pair.now);
    pair.run_for(500ms);
    EXPECT_EQ(pair.peers[0]->session()->number, pair.peers[1]->session()->number);
    EXPECT_GT(pair.ticks[0].sequence, sequence);
    EXPECT_EQ(pair.ticks[0].freshness, 1.0);
    EXPECT_EQ(pair.ticks[1].freshness, 1.0);
}

// The last messages of an ended run arrive after a message of the next run. They name a session
// that is settled, but in which no peer is heard.
TEST(PeerSession, FindsBackToThePresentRunWhenTheFormerOnesLastWordsComeLate)
{
    for (const std::size_t restarted : {0U, 1U}) {
        const std::size_t stayed = 1 - restarted;
        Pair pair;
        std::optional<wire::Hello> hello;
        for (int ms = 0; ms < 3000; ++ms) {
            pair.step();
            for (const wire::Message& message : pair.sent[restarted]) {
                const auto* said = std::get_if<wire::Hello>(&message);
                if (said != nullptr && said->nonce_heard != 0) hello = *said;
            }
        }
        const auto state = pair.state_sent_by(restarted);
        ASSERT_TRUE(hello && state);
        pair.kill(restarted);
        pair.run_for(1s);
        pair.start(restarted, settings_of(restarted, 1));
        pair.run_for(500ms);
        const std::uint32_t number = pair.peers[restarted]->session()->number;
        ASSERT_EQ(pair.peers[stayed]->session()->number, number);
        pair.cut = true;
        pair.run_for(1s);
        pair.peers[stayed]->on_datagram(wire::encode(*hello).bytes(), pair.now);
        pair.peers[stayed]->on_datagram(wire::encode(*state).bytes(), pair.now);
        ASSERT_EQ(pair.peers[stayed]->session()->number, state->session);
        pair.cut = false;
        pair.run_for(1s);
        EXPECT_EQ(pair.peers[stayed]->session()->number, number);
        EXPECT_EQ(pair.ticks[0].freshness, 1.0);
        EXPECT_EQ(pair.ticks[1].freshness, 1.0);
    }
}

// The state that a peer sends: its hand, its cube, and its belief about the other's.

TEST(PeerState, IsSentEveryTickNumberedFromOne)
{
    Pair pair;
    std::uint32_t expected = 0;
    for (int ms = 0; ms < 3000; ++ms) {
        pair.step();
        const auto state = pair.state_sent_by(0);
        if (pair.ticks[0].phase != Phase::running) {
            EXPECT_FALSE(state);
            continue;
        }
        ASSERT_TRUE(state);
        EXPECT_EQ(state->sequence, ++expected);
        EXPECT_EQ(pair.ticks[0].sequence, expected);
        EXPECT_EQ(state->sent, pair.now);
        EXPECT_EQ(state->session, pair.peers[0]->session()->number);
        ASSERT_TRUE(state->echo);
    }
    EXPECT_GT(expected, 1900U);
}

TEST(PeerState, TellsOfHandTouchAndForce)
{
    Pair pair;
    pair.run_until_started();
    Hand hand = pushing(0.002);
    hand.velocity = {{0.125, 0.25, -0.5}};
    pair.hands[0] = hand;
    pair.step();
    auto state = pair.state_sent_by(0);
    ASSERT_TRUE(state);
    EXPECT_TRUE(state->touching);
    EXPECT_FALSE(state->holding);
    EXPECT_NEAR(state->hip.x(), hand.hip.x(), 1e-9);
    EXPECT_EQ(state->hip_velocity, hand.velocity);
    EXPECT_NEAR(pair.ticks[0].touched.on_hand_at_start.x(), -(500 * 0.002 + 2 * 0.125), 1e-12);
    // The force sent and felt is the mean over the tick, while hand and cube move.
    auto world = scene::World::freeze(scene::paper_scene()).value();
    world.set_hand(0, {.position = hand.hip, .velocity = hand.velocity});
    world.tick();
    EXPECT_EQ(pair.ticks[0].touched.on_body, world.touch(0).on_body);
    EXPECT_NEAR(state->contact_force.x(), world.touch(0).on_body.x(), 1e-6);
    EXPECT_EQ(pair.ticks[0].force, -pair.ticks[0].touched.on_body);
    ASSERT_FALSE(state->bodies.empty());
    EXPECT_NEAR(state->bodies.first()->position.x(), pair.peers[0]->body().position.x(), 1e-9);

    pair.hands[0].gripping = true;
    pair.step();
    EXPECT_TRUE(pair.state_sent_by(0)->holding);
}

TEST(PeerState, IsOfTheSharedBodyWhateverItsPlaceInTheScene)
{
    Pair pair;
    for (const std::size_t side : {0U, 1U}) {
        Settings settings = settings_of(side);
        std::swap(settings.scene.bodies[0], settings.scene.bodies[1]);
        settings.introduction.scene_hash = scene::hash(settings.scene);
        pair.start(side, settings);
    }
    pair.run_until_started();
    pair.hands[0] = pushing(0.004);
    pair.run_for(100ms);
    EXPECT_GT(pair.peers[0]->body().position.x(), 0.001);
    EXPECT_NEAR(pair.peers[1]->body().position.x(), pair.peers[0]->body().position.x(), 1e-3);
    wire::State state = pair.state_sent_by(0).value();
    EXPECT_EQ(state.bodies.first()->body, 1U);
    state.sequence += 10;
    state.bodies.begin()->body = 0; // stands still for ever
    pair.peers[1]->on_datagram(wire::encode(state).bytes(), pair.now);
    EXPECT_EQ(pair.peers[1]->counters().implausible, 1U);
}

TEST(PeerForce, IsNoMoreThanTheGripLetsBeRenderedSafely)
{
    struct Case {
        double grip_damping;
        double share;
    };
    for (const Case& c : {Case{4.0, 1.0 / 3.0}, Case{12.0, 1.0}, Case{20.0, 1.0}}) {
        Pair pair;
        Settings settings = settings_of(0);
        settings.scene.hands.stiffness_n_per_m = 20'000.0; // times 1 ms / 2, and 2 N s/m: 12 N s/m
        settings.grip_damping_ns_per_m = c.grip_damping;
        pair.start(0, settings);
        pair.run_until_started();
        pair.hands[0] = pushing(0.0001);
        pair.step();
        const double on_body = pair.ticks[0].touched.on_body.x();
        EXPECT_GT(on_body, 0.5); // the scene itself is as stiff as it is said to be
        EXPECT_NEAR(pair.ticks[0].force.x(), -on_body * c.share, 1e-12);
    }
}

TEST(PeerForce, IsNoStifferThanTheDeviceIsSaidToRenderStably)
{
    struct Case {
        double stiffness_max;
        double grip_damping;
        double share;
    };
    for (const Case& c : {Case{0.0, 20.0, 1.0}, Case{20'000.0, 20.0, 1.0},
                          Case{5'000.0, 20.0, 0.25}, Case{5'000.0, 1.0, 1.0 / 12.0}}) {
        Pair pair;
        Settings settings = settings_of(0);
        settings.scene.hands.stiffness_n_per_m = 20'000.0; // needs a grip of 12 N s/m
        settings.grip_damping_ns_per_m = c.grip_damping;
        settings.stiffness_max_n_per_m = c.stiffness_max;
        pair.start(0, settings);
        pair.run_until_started();
        pair.hands[0] = pushing(0.0001);
        pair.step();
        const double on_body = pair.ticks[0].touched.on_body.x();
        EXPECT_GT(on_body, 0.5);
        EXPECT_NEAR(pair.ticks[0].force.x(), -on_body * c.share, 1e-12);
    }
}

TEST(PeerState, LeavesTheBodyOutASecondAfterItsLastStirAndThenRepeatsItEvery64th)
{
    Pair pair;
    pair.run_until_started();
    pair.hands[0] = pushing(0.002);
    pair.run_for(100ms);
    pair.hands[0] = {.hip = {{-0.05, 0.0, 0.0}}, .velocity = {}};
    base::Position before = pair.peers[0]->body().position;
    base::TimePoint stirred = pair.now;
    int bodies = 0;
    for (int ms = 0; ms < 5000; ++ms) {
        pair.step();
        const base::Position position = pair.peers[0]->body().position;
        if (base::norm(position - before) > 1e-9) stirred = pair.now;
        before = position;
        const auto state = pair.state_sent_by(0);
        ASSERT_TRUE(state);
        const bool due = pair.now - stirred < SceneCopy::body_lingers || state->sequence % 64 == 1;
        EXPECT_EQ(!state->bodies.empty(), due) << ms;
        bodies += static_cast<int>(state->bodies.size());
    }
    EXPECT_GT(bodies, 1000 + 3000 / 64);
    EXPECT_LT(bodies, 2000);
}

TEST(PeerLedger, HoldsTheTimeIntegralOfTheForceAndTheMotionOfTheHand)
{
    Pair pair;
    pair.run_until_started();
    pair.hands[0] = pushing(0.003);
    double impulse = 0.0;
    const double from = pair.peers[0]->body().position.x();
    for (int ms = 0; ms < 300; ++ms) {
        pair.step();
        impulse += pair.ticks[0].touched.on_body.x() * 1e-3;
    }
    pair.hands[0] = {.hip = {{-0.05, 0.0, 0.0}}, .velocity = {}};
    pair.run_for(300ms); // the cube coasts, which counts as this hand's effect, too
    const wire::BodyState body = *pair.state_sent_by(0).value().bodies.first();
    EXPECT_NEAR(static_cast<double>(body.caused_impulse_uns[0]), 1e6 * impulse, 1.0);
    const double moved = pair.peers[0]->body().position.x() - from;
    EXPECT_GT(moved, 0.001);
    EXPECT_NEAR(static_cast<double>(body.caused_displacement_um[0]), 1e6 * moved, 1.0);
    EXPECT_EQ(body.caused_impulse_uns[1], 0U);
}

TEST(PeerLedger, DoesNotClaimWhatTheOtherHandDidAfterThisOneLetGo)
{
    Pair pair;
    pair.run_until_started();
    pair.hands[0] = pushing(0.003);
    pair.run_for(100ms);
    pair.hands[0] = {.hip = {{-0.05, 0.0, 0.0}}, .velocity = {}};
    pair.hands[1] = {.hip = {{0.020, 0.0, 0.0}}, .velocity = {}}; // pushes left, at once
    const auto caused = [&] {
        return static_cast<std::int32_t>(
            pair.state_sent_by(0).value().bodies.first()->caused_displacement_um[0]);
    };
    pair.run_for(5ms); // the other side's touch is known
    const auto at_hand_over = caused();
    const double from = pair.peers[0]->body().position.x();
    pair.run_for(150ms);
    EXPECT_LT(pair.peers[0]->body().position.x() - from, -0.001);
    EXPECT_EQ(caused(), at_hand_over);
}

TEST(PeerLedger, LosesNothingWhenMessagesAreLost)
{
    Pair pair;
    pair.run_until_started();
    pair.hands[0] = pushing(0.003);
    pair.cut = true;
    pair.run_for(500ms);
    pair.cut = false;
    pair.run_for(10ms);
    const wire::BodyState said = *pair.state_sent_by(0).value().bodies.first();
    EXPECT_GT(said.caused_impulse_uns[0], 0U);
    pair.hands[0] = {.hip = {{-0.05, 0.0, 0.0}}, .velocity = {}};
    pair.run_for(500ms);
    const wire::BodyState later = *pair.state_sent_by(0).value().bodies.first();
    EXPECT_GE(later.caused_impulse_uns[0], said.caused_impulse_uns[0]);
}

TEST(PeerHand, ThatNobodyHoldsNeitherFeelsNorMovesAnything)
{
    Pair pair;
    pair.run_until_started();
    pair.hands[0] = pushing(0.003); // as an uncalibrated device may report
    pair.hands[0].present = false;
    pair.run_for(100ms);
    EXPECT_FALSE(pair.ticks[0].permitted);
    EXPECT_EQ(pair.ticks[0].force, base::Force{});
    EXPECT_EQ(pair.peers[0]->body().position, base::Position{});
    EXPECT_FALSE(pair.state_sent_by(0)->touching);
    pair.hands[0].present = true;
    pair.run_for(5ms);
    EXPECT_TRUE(pair.state_sent_by(0)->touching);
}

TEST(PeerHand, ThatIsNotUsableIsCountedAndNeitherFeelsNorMovesAnything)
{
    for (const glm::dvec3& broken :
         {glm::dvec3{nan, 0.0, 0.0}, glm::dvec3{0.0, -1e300, 0.0}, glm::dvec3{0.0, 0.0, 10.1}}) {
        Pair pair;
        pair.run_until_started();
        pair.hands[0].hip = {broken};
        pair.run_for(100ms);
        EXPECT_EQ(pair.peers[0]->counters().unusable_hand, 100U);
        EXPECT_FALSE(pair.ticks[0].permitted);
        EXPECT_EQ(pair.ticks[0].force, base::Force{});
        EXPECT_EQ(pair.peers[0]->body().position, base::Position{});
        EXPECT_EQ(pair.state_sent_by(0)->hip, base::Position{});
        pair.hands[0] = pushing(0.001);
        pair.hands[0].velocity = {{0.0, nan, 0.0}};
        pair.step();
        EXPECT_FALSE(pair.ticks[0].permitted);
        pair.hands[0].velocity = {};
        pair.step();
        EXPECT_TRUE(pair.ticks[0].permitted);
        EXPECT_TRUE(pair.ticks[0].touched.touching);
    }
}

TEST(PeerCounters, TellWhatCouldNotBeUsed)
{
    Pair pair;
    pair.run_until_started();
    Peer& peer = *pair.peers[0];
    const Counters before = peer.counters();
    wire::State state = pair.state_sent_by(1).value();
    const auto give = [&] { peer.on_datagram(wire::encode(state).bytes(), pair.now); };
    give(); // a reordered state: the copy makes it a duplicate
    give();
    state.session ^= 1U;
    give();
    state.session ^= 1U;
    state.sequence += 10;
    state.hip = {{1.1, 0.0, 0.0}}; // eight times as far as the scene's bodies reach: 1.08 m
    give();
    state.hip = {};
    state.hip_velocity = {{0.0, -11.0, 0.0}}; // through all of that in less than 0.1 s
    give();
    state.hip_velocity = {};
    state.bodies.add(wire::BodyState{}).position = {{0.0, 0.0, 1.1}};
    give();
    peer.on_datagram({}, pair.now);
    peer.on_datagram(std::array<std::byte, 9>{}, pair.now);
    EXPECT_EQ(peer.counters().states - before.states, 1U);
    EXPECT_EQ(peer.counters().outdated - before.outdated, 1U);
    EXPECT_EQ(peer.counters().other_session - before.other_session, 1U);
    EXPECT_EQ(peer.counters().implausible - before.implausible, 3U);
    EXPECT_EQ(peer.counters().malformed - before.malformed, 2U);
    peer.on_datagram(wire::encode(wire::Bye{99, wire::ByeReason::finished}).bytes(), pair.now);
    EXPECT_EQ(peer.counters().byes - before.byes, 1U);
    EXPECT_FALSE(peer.is_alone()); // a goodbye of another session
}

} // namespace
} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/remote_proxy.hpp"
#include "tests/unit/peer/core/sync/copy.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::peer::remote_proxy_test {
namespace {

/// A copy with one other peer, which pushes the cube from the right. Messages come each
/// millisecond, 5 ms old.
struct Pushed {
    explicit Pushed(const RemoteProxyOptions& options = {}) : copy{prepared(options)} {}

    static RemoteProxy prepared(const RemoteProxyOptions& options)
    {
        RemoteProxy algorithm{options};
        algorithm.prepare(1, paper_world());
        return algorithm;
    }

    /// The other hand intends to be `intention_mm` to the left of its place.
    void play(int ticks, double hip_mm, double intention_mm, double body_mm,
              std::uint32_t work_per_tick_uj = 0)
    {
        for (int i = 0; i < ticks; ++i) {
            ++ms;
            wire::State state;
            state.sequence = ++sequence;
            state.sent = at_ms(ms - 5.0);
            state.touching = true;
            state.hip = {{1e-3 * hip_mm, 0.0, 0.0}};
            state.intention = {{-1e-3 * intention_mm, 0.0, 0.0}};
            state.work_uj = work_uj += work_per_tick_uj;
            wire::BodyState& body = state.bodies.add(wire::BodyState{});
            body.position = {{1e-3 * body_mm, 0.0, 0.0}};
            hear(state, copy.remote.update(state, at_ms(ms)));
            last = copy.tick(ms);
        }
    }
    void hear(const wire::State& state, bool taken)
    {
        copy.algorithm.hear({.state = state,
                             .arrived = at_ms(ms),
                             .taken = taken,
                             .clock = RemoteClock{copy.clock},
                             .force_max_n = force_max});
    }

    Copy<RemoteProxy> copy;
    double ms = 0.0;
    std::uint32_t sequence = 0;
    std::uint32_t work_uj = 0;
    Outcome last;
};

TEST(RemoteProxy, PushesTheBodyAsAHandDoes)
{
    Pushed there;
    there.play(300, 25.0 - 1.0, 20.0, 0.0);
    EXPECT_TRUE(there.last.remote_touching);
    EXPECT_LT(there.last.remote_force.x(), -0.2); // most of its motion is over
    EXPECT_LT(there.copy.x_mm(), -1.0);
    EXPECT_EQ(there.last.on_hand, base::Force{}); // the own hand is away, and nothing reaches it
}

TEST(RemoteProxy, EntersAsDeepAsItIsOverThereWhereverThisCopyHasTheBody)
{
    Pushed there;
    there.copy.world.place(0, {{0.010, 0.0, 0.0}}, {});
    there.play(1, 25.0 - 2.0, 0.0, 0.0); // 2 mm deep in a cube that is 10 mm away
    EXPECT_NEAR(there.last.remote_force.x(), -1.0, 0.05);
    ASSERT_TRUE(there.last.remote_hip);
    EXPECT_NEAR(there.last.remote_hip->x(), 0.035 - 0.002, 1e-4);
}

TEST(RemoteProxy, GoesWhenItsOwnerLetsGo)
{
    Pushed there;
    there.play(50, 24.0, 5.0, 0.0);
    wire::State state;
    state.sequence = ++there.sequence;
    state.sent = at_ms(there.ms);
    ++there.ms;
    there.hear(state, there.copy.remote.update(state, at_ms(there.ms)));
    const Outcome outcome = there.copy.tick(there.ms);
    EXPECT_FALSE(outcome.remote_touching);
    EXPECT_EQ(outcome.remote_force, base::Force{});
}

TEST(RemoteProxy, GivesNoMoreThanItsAccountHoldsWhenItsOwnerDoesNoWork)
{
    // The owner's messages claim an intention far to the left, and no work.
    RemoteProxyOptions poor;
    poor.account_j = 0.002;
    poor.power_w = 0.0;
    poor.correction_rate_hz = 0.0;
    Pushed there{poor};
    there.play(3000, 24.0, 60.0, 0.0);
    EXPECT_GT(there.copy.algorithm.account_j(), -0.001);
    const double poor_way_mm = -there.copy.x_mm();
    Pushed rich{RemoteProxyOptions{.account_j = 10.0, .correction_rate_hz = 0.0}};
    rich.play(3000, 24.0, 60.0, 0.0);
    EXPECT_LT(poor_way_mm, 0.25 * -rich.copy.x_mm());
}

TEST(RemoteProxy, TheAccountGrowsByTheWorkOfTheOwnerAlsoOverTheEndOfTheCounter)
{
    Pushed there;
    there.work_uj = 0xffff'ff00U;
    there.play(1, 60.0, 0.0, 0.0);
    const double before = there.copy.algorithm.account_j();
    wire::State state;
    state.sequence = ++there.sequence;
    state.sent = at_ms(there.ms);
    state.work_uj = 0x0000'0f00U; // 4096 uJ more
    there.hear(state, true);
    EXPECT_NEAR(there.copy.algorithm.account_j() - before, 4096e-6, 1e-12);
    state.work_uj = 0x0000'0000U; // and 3840 uJ less again: the energy returned to it
    ++state.sequence;
    there.hear(state, true);
    EXPECT_NEAR(there.copy.algorithm.account_j() - before, 256e-6, 1e-12);
}

TEST(RemoteProxy, IsTheSameToTheBitWhenMessagesComeTwiceOrLate)
{
    Pushed plain;
    Pushed repeated;
    plain.play(100, 24.0, 10.0, 0.0);
    repeated.play(100, 24.0, 10.0, 0.0);
    wire::State stale;
    stale.sequence = 50;
    stale.sent = at_ms(45.0);
    stale.touching = true;
    stale.work_uj = 123456;
    repeated.hear(stale, repeated.copy.remote.update(stale, at_ms(repeated.ms)));
    plain.play(100, 24.0, 10.0, 0.0);
    repeated.play(100, 24.0, 10.0, 0.0);
    EXPECT_EQ(plain.copy.world.hash(), repeated.copy.world.hash());
    EXPECT_EQ(plain.copy.algorithm.account_j(), repeated.copy.algorithm.account_j());
}

TEST(RemoteProxy, ComesToTheLeadersPoseOnceBothHandsAreOffWithoutTheDelayInTheLoop)
{
    Pushed there;
    there.play(20, 24.0, 0.0, 0.0); // it has touched last, and leads
    for (int i = 0; i < 1500; ++i) {
        ++there.ms;
        wire::State state;
        state.sequence = ++there.sequence;
        state.sent = at_ms(there.ms - 200.0);
        wire::BodyState& body = state.bodies.add(wire::BodyState{});
        body.position = {{0.012, 0.0, 0.0}};
        there.hear(state, there.copy.remote.update(state, at_ms(there.ms)));
        there.last = there.copy.tick(there.ms);
        ASSERT_LT(there.copy.x_mm(), 12.1) << i; // no swinging beyond
    }
    EXPECT_NEAR(there.copy.x_mm(), 12.0, 0.01);
}

/// Where a copy at 3 mm ends that hears of the other copy's body at 12 mm, at rest and untouched.
/// Both hands have touched. This copy knows of its own touch alone, or of the other's alone.
double settled_mm(bool knows_own_touch, std::size_t lower_ids, int ticks)
{
    Pushed there;
    there.copy.lower_ids = lower_ids;
    if (knows_own_touch) {
        for (int i = 0; i < 20; ++i) static_cast<void>(there.copy.tick(++there.ms, pushing_hip(0)));
        static_cast<void>(there.copy.tick(++there.ms, pushing_hip(0.002)));
    } else {
        there.play(20, 24.0, 0.0, 0.0);
    }
    there.copy.world.place(0, {{0.003, 0.0, 0.0}}, {});
    for (int i = 0; i < ticks; ++i) {
        ++there.ms;
        wire::State state;
        state.sequence = ++there.sequence;
        state.sent = at_ms(there.ms - 5.0);
        wire::BodyState& body = state.bodies.add(wire::BodyState{});
        body.position = {{0.012, 0.0, 0.0}};
        there.hear(state, there.copy.remote.update(state, at_ms(there.ms)));
        there.last = there.copy.tick(there.ms);
    }
    return there.copy.x_mm();
}

TEST(RemoteProxy, LetsTheLowestIdLeadOnceNoHandTouchesWhoeverIsTakenForTheLast)
{
    for (const bool knows_own_touch : {true, false}) {
        EXPECT_NEAR(settled_mm(knows_own_touch, 1, 1000), 12.0, 0.01) << knows_own_touch;
    }
    // The lower id's own copy rests. For 500 ms the last hand that touched decides.
    EXPECT_NEAR(settled_mm(true, 0, 1000), 3.0, 0.01);
    EXPECT_NEAR(settled_mm(true, 1, 450), 3.0, 0.01);
    EXPECT_NEAR(settled_mm(false, 0, 450), 12.0, 0.01);
}

TEST(RemoteProxy, LeavesTheBodyToTheOwnHandWhileThatTouches)
{
    Pushed there;
    there.play(20, 24.0, 0.0, 0.0);
    wire::State let_go;
    let_go.sequence = ++there.sequence;
    let_go.sent = at_ms(there.ms);
    wire::BodyState& body = let_go.bodies.add(wire::BodyState{});
    body.position = {{-0.050, 0.0, 0.0}};
    there.hear(let_go, there.copy.remote.update(let_go, at_ms(there.ms)));
    scene::World alone = there.copy.world;
    alone.set_hand(1, peer::away);
    for (int i = 0; i < 100; ++i) {
        tick(alone, pushing_hip(1e-3 + 1e-5 * i));
        static_cast<void>(there.copy.tick(++there.ms, pushing_hip(1e-3 + 1e-5 * i)));
    }
    EXPECT_NEAR(1e3 * alone.body(0).position.x(), there.copy.x_mm(), 0.3);
}

} // namespace
} // namespace hapnet::peer::remote_proxy_test

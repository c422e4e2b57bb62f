// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The states of a session with several rotating bodies.
#include "scene/text/text.hpp"
#include "tests/unit/peer/core/pair.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::peer::peer_bodies_test {
namespace {

/// Two peers that share three cubes: 0 in the middle, 1 on the left, 2 on the right.
Pair pair_with_cubes()
{
    Pair pair;
    for (const std::size_t side : {0U, 1U}) {
        Settings settings = settings_of(side, 1);
        settings.scene = scene::load_scene("stack-of-three", {}).value();
        settings.introduction.scene_hash = hash(settings.scene);
        pair.start(side, settings);
        pair.hands[side] = {.hip = {{0.0, 0.2, 0.0}}, .velocity = {}};
    }
    pair.run_until_started();
    return pair;
}

std::vector<std::uint16_t> ids_of(const wire::State& state)
{
    std::vector<std::uint16_t> ids;
    for (const wire::BodyState& body : state.bodies) ids.push_back(body.body);
    return ids;
}

TEST(PeerWithBodies, SaysAllOfThemInEvery64thStateAndNoneBetweenWhileNothingMoves)
{
    Pair pair = pair_with_cubes();
    pair.run_for(3s);
    std::size_t full = 0;
    for (int ms = 0; ms < 128; ++ms) {
        pair.step();
        const auto state = pair.state_sent_by(0);
        ASSERT_TRUE(state);
        const bool is_due = state->sequence % Remote::body_every == 1;
        EXPECT_EQ(state->bodies.size(), is_due ? 3U : 0U) << state->sequence;
        if (is_due) ++full;
        for (const wire::BodyState& body : state->bodies) EXPECT_TRUE(body.turning);
    }
    EXPECT_EQ(full, 2U);
}

TEST(PeerWithBodies, SaysTheOneThatItPushesAndWhatItHasDoneToIt)
{
    Pair pair = pair_with_cubes();
    pair.run_for(3s);
    // From the left, above the middle and beside it: 2 mm deep is 1 N, more than friction takes.
    pair.hands[0] = {.hip = {{-0.065, -0.024, 0.006}}, .velocity = {}};
    wire::State state;
    for (int ms = 0; ms < 50; ++ms) {
        pair.step();
        state = pair.state_sent_by(0).value();
        if (state.sequence % Remote::body_every != 1 && ms > 0) {
            EXPECT_EQ(ids_of(state), (std::vector<std::uint16_t>{1}));
        }
    }
    const wire::BodyState* const body = state.bodies.find(1);
    ASSERT_NE(body, nullptr);
    const auto given = wire::difference(body->caused_impulse_uns, {});
    const auto moved = wire::difference(body->caused_displacement_um, {});
    const auto twisted = wire::difference(body->turning->caused_angular_impulse_unms, {});
    EXPECT_GT(given[0], 1000);
    EXPECT_GT(moved[0], 0);
    // To the right at z > 0: about +y, with a lever of 6 mm.
    EXPECT_NEAR(twisted[1], 0.006 * given[0], 0.2 * 0.006 * given[0]);
    // The other peer's body follows, with its orientation.
    pair.step();
    const scene::BodyState here = pair.peers[0]->world().body(1);
    const scene::BodyState there = pair.peers[1]->world().body(1);
    EXPECT_NEAR(here.position.x(), there.position.x(), 1e-3);
    EXPECT_GT(there.position.x(), -0.05);
}

TEST(PeerWithBodies, DropsAStateOfABodyThatIsNotSharedOrTurnsWhereItCannot)
{
    Pair pair = pair_with_cubes();
    const auto heard = [&](const wire::BodyState& body) {
        wire::State state = pair.state_sent_by(1).value();
        state.sequence += 1;
        state.bodies.clear();
        state.bodies.add(body);
        const auto before = pair.peers[0]->counters().implausible;
        pair.peers[0]->on_datagram(wire::encode(state).bytes(), pair.now);
        return pair.peers[0]->counters().implausible == before;
    };
    wire::BodyState body;
    body.body = 1;
    EXPECT_FALSE(heard(body)); // it can turn, but the state has no orientation
    body.turning.emplace();
    body.body = 7;
    EXPECT_FALSE(heard(body));
    body.body = 1;
    body.turning->angular_velocity = {0.0, 1e6, 0.0};
    EXPECT_FALSE(heard(body));
    body.turning->angular_velocity = {0.0, 1.0, 0.0};
    EXPECT_TRUE(heard(body));
}

} // namespace
} // namespace hapnet::peer::peer_bodies_test

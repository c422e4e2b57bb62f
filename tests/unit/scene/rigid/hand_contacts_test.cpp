// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/hand_contacts.hpp"

#include "scene/maths/rotation.hpp"
#include "scene/world.hpp"
#include "tests/support/scene/dice.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene::hand_contacts_test {
namespace {

struct Moment {
    HandInput input;
    SweptBox box;
    glm::dvec3 velocity{0.0};
};

/// The next moment of a hand that presses a face, slides over it and sometimes jumps, and of a box
/// that hardly rotates, or does.
Moment next(const Moment& last, test::Dice& dice)
{
    Moment now = last;
    now.box.box.centre += 1e-5 * dice.vector();
    now.velocity = 1e-2 * dice.vector();
    now.box.spin = 1e-3 * dice.vector();
    if (dice.one_in(7)) {
        now.box.orientation = rotated(now.box.orientation, 1e-2 * dice.vector());
        now.box.box.axes = axes_of(now.box.orientation);
        ++now.box.turns;
    }
    glm::dvec3& hand = now.input.position.value;
    hand += dice.one_in(10) ? 5e-3 * dice.vector() : 1e-4 * dice.vector();
    if (dice.one_in(40)) hand = now.box.box.centre + glm::dvec3{0.0, 0.023, 0.0};
    now.input.velocity = {1e-2 * dice.vector()};
    return now;
}

/// Finds the contacts of one tick.
std::span<const HandSpring> tick(HandContacts& contacts, const WorldConfig& config,
                                 WorldState& state, const Moment& moment)
{
    state.hands[0] = moment.input;
    contacts.begin_step(config, state);
    contacts.collide(config, state, 0, {0, 0, true, moment.box, moment.velocity});
    contacts.forget_departed(0);
    return contacts.springs_on(0).springs;
}

TEST(HandContacts, AFaceThatIsKeptHasTheBitsOfOneThatIsFoundAnew)
{
    const Description description = paper_scene();
    WorldConfig config{.hands = description.hands};
    config.hands.count = 1;
    WorldState state{.bodies = Bodies{description}};
    test::Dice dice{base::Seed{7}.stream("hands")};
    Moment before;
    before.input.position = {{0.0, 0.023, 0.0}};
    HandContacts kept{config};
    std::ignore = tick(kept, config, state, before);
    int amid = 0;
    for (int i = 0; i < 3000; ++i) {
        const Moment now = next(before, dice);
        const auto springs = tick(kept, config, state, now);
        const HandTouch touch = state.touches[0];
        // It knows only the previous tick.
        HandContacts fresh{config};
        std::ignore = tick(fresh, config, state, before);
        const auto expected = tick(fresh, config, state, now);
        before = now;
        // For a hand within the box, the entry face matters.
        const glm::dvec3 inside = glm::abs(to_local(now.box.box, now.input.position.value));
        if (inside.x <= 0.02 && inside.y <= 0.02 && inside.z <= 0.02) continue;
        ASSERT_EQ(springs.size(), expected.size()) << i;
        EXPECT_EQ(touch.depth_m, state.touches[0].depth_m);
        EXPECT_EQ(touch.on_hand_at_start.value, state.touches[0].on_hand_at_start.value);
        if (springs.empty() || !springs[0].is_amid_face || !expected[0].is_amid_face) continue;
        ++amid;
        EXPECT_EQ(springs[0].normal, expected[0].normal) << i;
        EXPECT_EQ(springs[0].arm, expected[0].arm) << i;
        EXPECT_EQ(springs[0].gap, expected[0].gap) << i;
    }
    EXPECT_GT(amid, 500);
}

TEST(HandContacts, WhatEachDoesIsReported)
{
    Description description;
    description.bodies.resize(2);
    description.bodies[1].position = base::Position{{0.1, 0.0, 0.0}};
    WorldConfig config;
    config.hands.count = 2;
    config.hands.radius_m = 0.005;
    WorldState state{.bodies = Bodies{description}};
    state.hands[0].position = base::Position{{-0.024, 0.0, 0.0}};
    state.hands[1].position = base::Position{{0.124, 0.0, 0.0}};

    HandContacts contacts{config};
    contacts.begin_step(config, state);
    for (const BodyId body : {0U, 1U}) {
        SweptBox box;
        box.box.centre = description.bodies[body].position.value;
        contacts.collide(config, state, body, {body, body, true, box, glm::dvec3{0.0}});
        const auto [springs, work] = contacts.springs_on(body);
        ASSERT_EQ(springs.size(), 1U);
        work[0].impulse = {1e-3, 2e-3, 0.0};
        contacts.store_impulses(body);
    }
    contacts.report_forces(config, state);
    EXPECT_EQ(state.touches[0].on_body.value, (glm::dvec3{1.0, 2.0, 0.0}));
    EXPECT_EQ(state.touches[1].on_body.value, (glm::dvec3{1.0, 2.0, 0.0}));
    EXPECT_EQ(state.touches[1].on_hand.value, (glm::dvec3{-1.0, -2.0, 0.0}));
}

} // namespace
} // namespace hapnet::scene::hand_contacts_test

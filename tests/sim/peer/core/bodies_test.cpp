// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Rotating bodies, and several bodies, shared by two and three peers over bad networks drawn from a
// seed.
#include "scene/maths/rotation.hpp"
#include "scene/text/text.hpp"
#include "tests/support/seeds.hpp"
#include "tests/unit/peer/core/group.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hapnet::peer::bodies_test {
namespace {

constexpr base::Duration length = 12s; // 9 s hands on
constexpr double limit_n = 3.3;
/// As in SceneLaws: the direction of a force is held while the body turns.
constexpr double force_law = 1.0 + 1e-6;
constexpr double apart_max_m = 0.1e-3;
constexpr double turned_max_rad = 0.1 * 3.14159265358979 / 180.0;

scene::Description turning_cube() { return scene::load_scene("turning", {}).value(); }

/// The cubes of that scene, stacked.
scene::Description stack_of_three()
{
    scene::Description scene = scene::load_scene("stack-of-three", {}).value();
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        scene.bodies[i].position = {{0.0, -0.028 + 0.024 * static_cast<double>(i), 0.0}};
    return scene;
}

bool are_hands_off(base::Duration since_start)
{
    return since_start >= length - Peer::hands_off_length;
}

Hand away() { return {.hip = {{0.0, 0.3, 0.0}}, .velocity = {}}; }

/// Pushes from both sides, to and fro, off the middle, so that the cube rotates and moves.
Hand turn(std::size_t side, base::Duration since_start)
{
    if (are_hands_off(since_start)) return away();
    const double t = base::to_seconds(since_start);
    const double sign = side % 2 == 0 ? -1.0 : 1.0;
    const double rate = 3.0 + static_cast<double>(side);
    const double depth = 0.006 * std::sin(rate * t);
    return {.hip = {{sign * (0.026 - depth), 0.0, sign * (0.008 + 0.008 * std::sin(0.7 * t))}},
            .velocity = {{-sign * 0.006 * rate * std::cos(rate * t), 0.0, 0.0}}};
}

/// Each hand pushes at another height, hard enough that the stack falls over sooner or later.
Hand topple(std::size_t side, base::Duration since_start)
{
    if (are_hands_off(since_start)) return away();
    const double t = base::to_seconds(since_start);
    const double sign = side % 2 == 0 ? -1.0 : 1.0;
    const double rate = 1.0 + 0.4 * static_cast<double>(side);
    const double way = 0.03 * (1.0 - std::cos(rate * t)) / 2.0;
    const double height = -0.028 + 0.024 * static_cast<double>((side + 1) % 3);
    return {.hip = {{sign * (0.030 - way), height, 0.0}},
            .velocity = {{-sign * 0.015 * rate * std::sin(rate * t), 0.0, 0.0}}};
}

Settings settings_for(Group& group, std::size_t side, const scene::Description& scene,
                      const std::string& algorithm = "base")
{
    Settings settings = group.settings_of_group(side);
    settings.scene = scene;
    settings.algorithm = algorithm_named(algorithm).value();
    settings.introduction.scene_hash = hash(settings.scene);
    settings.length = length;
    return settings;
}

struct Case {
    scene::Description (*scene)();
    Group::Move move;
    std::string algorithm;
};

Group group_of(std::size_t size, base::Seed seed, const Case& one)
{
    Group group{size, seed};
    group.move = one.move;
    for (std::size_t side = 0; side < size; ++side)
        group.start(side, settings_for(group, side, one.scene(), one.algorithm));
    return group;
}

/// The largest differences between copies.
struct Apart {
    double metres = 0.0;
    double radians = 0.0;
};
Apart apart(const Group& group)
{
    Apart most;
    for (const auto& a : group.peers) {
        for (const auto& b : group.peers) {
            for (const SharedBody& shared : a->shared()) {
                const scene::BodyState here = a->world().body(shared.id);
                const scene::BodyState there = b->world().body(shared.id);
                most.metres = std::max(most.metres, base::norm(here.position - there.position));
                const glm::dvec3 turn = scene::turn_between(here.orientation, there.orientation);
                most.radians = std::max(most.radians, base::norm(base::Displacement{turn}));
            }
        }
    }
    return most;
}

void expect_sound(const Group& group)
{
    for (std::size_t side = 0; side < group.peers.size(); ++side) {
        const Tick& tick = group.ticks[side];
        ASSERT_TRUE(base::is_finite(tick.force));
        // A hand may touch several bodies at once, as many as fit around it.
        ASSERT_LE(base::norm(tick.force), 3.0 * limit_n * force_law);
        ASSERT_LE(base::norm(tick.touched.on_body), limit_n * force_law);
        for (const SharedBody& shared : group.peers[side]->shared()) {
            const scene::BodyState body = group.peers[side]->world().body(shared.id);
            ASSERT_TRUE(base::is_finite(body.position));
            ASSERT_LE(base::norm(body.position - base::Position{}), 1.0);
        }
        const Counters& counters = group.peers[side]->counters();
        ASSERT_EQ(counters.malformed + counters.implausible + counters.unusable_hand, 0U);
    }
}

void run_to(Group& group, base::TimePoint end)
{
    while (group.now < end) {
        group.step();
        expect_sound(group);
        if (testing::Test::HasFatalFailure()) return;
    }
}

void expect_agreement(const Group& group)
{
    const Apart end = apart(group);
    EXPECT_LE(end.metres, apart_max_m);
    EXPECT_LE(end.radians, turned_max_rad);
}

/// Returns the largest motion of a body: its way and its reach times its rotation, in metres.
double farthest_m(const Peer& peer, const std::vector<scene::BodyState>& before)
{
    double farthest = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const SharedBody& shared = peer.shared()[i];
        const scene::BodyState after = peer.world().body(shared.id);
        const glm::dvec3 turn = scene::turn_between(before[i].orientation, after.orientation);
        farthest = std::max(farthest, base::norm(after.position - before[i].position) +
                                          shared.reach_m * base::norm(base::Displacement{turn}));
    }
    return farthest;
}

/// Plays to half a second before the end, 2.5 s after hands off. Returns how far a body went from
/// where it began, in the copy of the last peer.
double play(Group& group)
{
    for (int ms = 0; ms < 5000 && !group.all_play(); ++ms) group.step();
    EXPECT_TRUE(group.all_play());
    const Peer& last = *group.peers.back();
    std::vector<scene::BodyState> before;
    for (const SharedBody& shared : last.shared()) before.push_back(last.world().body(shared.id));
    const base::TimePoint end = last.session()->start + length - 500ms;
    double farthest = 0.0;
    while (group.now < end && !testing::Test::HasFatalFailure()) {
        run_to(group, std::min(end, group.now + 100ms));
        farthest = std::max(farthest, farthest_m(last, before));
    }
    return farthest;
}

class SharedBodiesOf : public testing::TestWithParam<Case> {};

TEST_P(SharedBodiesOf, TwoOrThreeAgreeAfterHandsOffWhateverTheDelay)
{
    for (const std::size_t size : {2U, 3U}) {
        for (const auto delay : {0ms, 40ms, 160ms, 200ms}) {
            SCOPED_TRACE(std::to_string(size) + " peers, ms: " + std::to_string(delay.count()));
            Group group = group_of(size, base::Seed{size}, GetParam());
            std::ranges::fill(group.paths, Group::Path{.delay = delay, .loss = 0.3});
            EXPECT_GT(play(group), 0.005);
            expect_agreement(group);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, SharedBodiesOf,
                         testing::Values(Case{turning_cube, turn, "base"},
                                         Case{stack_of_three, topple, "base"},
                                         Case{turning_cube, turn, "remote-proxy"},
                                         Case{stack_of_three, topple, "remote-proxy"}),
                         [](const auto& test) {
                             return std::string{test.index % 2 == 0 ? "turning" : "stack"} +
                                    (test.index < 2 ? "_base" : "_proxies");
                         });

scene::Description bench() { return scene::load_scene("bench", {}).value(); }

/// Moves randomly among the bodies, gripping now and then: drawn again each second.
Hand fumble(const base::RandomStream& draw, std::size_t side, base::Duration since_start)
{
    if (are_hands_off(since_start)) return away();
    const double t = base::to_seconds(since_start);
    const auto second = static_cast<std::uint32_t>(std::max(0.0, t));
    const auto number = static_cast<std::uint32_t>(side);
    const auto place = [&](std::uint32_t of_second) {
        const auto part = [&](std::uint32_t axis) {
            return draw.uniform(number, 4 * of_second + axis) - 0.5;
        };
        return glm::dvec3{0.12 * part(0), 0.06 * part(1) - 0.005, 0.06 * part(2)};
    };
    const double share = std::max(0.0, t) - second;
    const double smooth = share * share * (3.0 - 2.0 * share);
    const glm::dvec3 from = place(second), to = place(second + 1);
    const bool grips = draw.uniform(number, 4 * second + 3) < 0.4;
    return {.hip = {from + smooth * (to - from)},
            .velocity = {6.0 * share * (1.0 - share) * (to - from)},
            .gripping = grips};
}

class AnyBodies : public testing::TestWithParam<std::uint64_t> {};

TEST_P(AnyBodies, AgreeAfterHandsOffWhateverTheHandsAndTheNetworkDid)
{
    const base::Seed seed{GetParam()};
    const auto draw = seed.stream("bodies");
    const std::size_t size = 2 + draw.below(2, 0);
    const std::array scenes{turning_cube, stack_of_three, bench};
    const char* const algorithm = GetParam() % 2 == 0 ? "base" : "remote-proxy";
    Group group = group_of(size, seed, {scenes.at(draw.below(3, 1)), nullptr, algorithm});
    constexpr std::array delays{0ms, 40ms, 160ms};
    for (auto& path : group.paths)
        path = {.delay = delays.at(draw.below(3, 2)), .spread_us = 10'000, .loss = 0.3};
    for (int ms = 0; ms < 5000 && !group.all_play(); ++ms) group.step();
    ASSERT_TRUE(group.all_play());
    const base::TimePoint start = group.peers.front()->session()->start;
    const auto hands = seed.stream("hands");
    while (group.now < start + length - 500ms) {
        for (std::size_t side = 0; side < size; ++side)
            group.hands[side] = fumble(hands, side, group.now - start);
        group.step();
        expect_sound(group);
        if (HasFatalFailure()) return;
    }
    expect_agreement(group);
}

INSTANTIATE_TEST_SUITE_P(Seed, AnyBodies, testing::Range(std::uint64_t{0}, test::seeds(20)));
INSTANTIATE_TEST_SUITE_P(All, AnyBodies, testing::Range(test::seeds(20), std::uint64_t{60}));

/// A late peer starts with all bodies where the others have them.
TEST(SharedBodies, AreTakenOverByOneWhoComesLate)
{
    Group group = group_of(3, base::Seed{4}, {bench, nullptr, "base"});
    std::ranges::fill(group.paths, Group::Path{.delay = 20ms, .loss = 0.3});
    for (int ms = 0; ms < 5000 && !group.all_play(); ++ms) group.step();
    const auto hands = base::Seed{4}.stream("hands");
    const base::TimePoint start = group.peers.front()->session()->start;
    const auto play_until = [&](base::TimePoint end) {
        while (group.now < end) {
            for (std::size_t side = 0; side < 3; ++side)
                group.hands[side] = fumble(hands, side, group.now - start);
            group.step();
        }
    };
    play_until(start + 5s);
    const Settings again = settings_for(group, 2, bench());
    group.kill(2);
    play_until(start + 6s);
    group.start(2, again);
    play_until(start + length - 500ms);
    ASSERT_TRUE(group.all_play());
    expect_agreement(group);
}

} // namespace
} // namespace hapnet::peer::bodies_test

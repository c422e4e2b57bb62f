// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Every branch of the paper's hybrid algorithm, to the last bit, against a second world that is
// driven by hand.
#include "peer/core/sync/algorithm.hpp"
#include "tests/support/session/fresh.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer::base_algorithm_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};
constexpr scene::HandInput away{.present = false};

wire::State heard(bool touching, double force_x, double body_x, double body_speed)
{
    wire::State state;
    state.sequence = 1;
    state.touching = touching;
    state.contact_force = {{force_x, 0.0, 0.0}};
    wire::BodyState& body = state.bodies.add(wire::BodyState{});
    body.position = {{body_x, 0.0, 0.0}};
    body.velocity = {{body_speed, 0.0, 0.0}};
    return state;
}

scene::World paper_world() { return scene::World::freeze(scene::paper_scene()).value(); }

/// A hand from the left, at this depth in the cube at the origin: 2 mm are 1 N.
scene::HandInput pushing(double depth, double speed = 0.0)
{
    return {.position = {{-0.025 + depth, 0.0, 0.0}}, .velocity = {{speed, 0.0, 0.0}}};
}

/// A copy of the scene, the other side's messages, and the algorithm between them.
class Copy {
public:
    void hear(const wire::State& state) { remote_.update(state, now); }

    scene::HandTouch tick(const scene::HandInput& hand, double freshness = 1.0, bool yields = true)
    {
        world.set_hand(own_hand, hand);
        look_when_fresh_by(freshness, remote_);
        const Situation situation{
            .now = now, .others = {&remote_, 1}, .remote = remote_, .yields = yields};
        const Outcome outcome = algorithm_.tick(world, situation);
        now += 1ms;
        return outcome.touched;
    }
    [[nodiscard]] double x() const { return world.body(0).position.x(); }
    [[nodiscard]] double speed() const { return world.body(0).velocity.x(); }

    base::TimePoint now = start;
    scene::World world = paper_world();

private:
    Remote remote_{{}};
    BaseAlgorithm algorithm_;
};

/// Plays a tick without the other side, apart from a push along x.
void tick(scene::World& world, const scene::HandInput& hand, double push_x = 0.0)
{
    world.set_hand(own_hand, hand);
    world.push(0, {{push_x, 0.0, 0.0}});
    world.tick();
}

TEST(BaseAlgorithm, MovesABodyThatBothPushByTheSumOfTheForces)
{
    Copy copy;
    scene::World expected = paper_world();
    copy.hear(heard(true, -0.5, 0.05, 0.3)); // its place in the other copy does not matter now
    for (int ms = 0; ms < 100; ++ms) {
        const scene::HandTouch touched = copy.tick(pushing(0.004));
        tick(expected, pushing(0.004), -0.5);
        ASSERT_EQ(copy.world.hash(), expected.hash()) << ms;
        ASSERT_TRUE(touched.touching);
        ASSERT_EQ(touched.on_body, expected.touch(own_hand).on_body);
    }
    EXPECT_GT(copy.x(), 0.001);
}

TEST(BaseAlgorithm, LetsTheStrongerDecideTheDirection)
{
    Copy copy;
    copy.hear(heard(true, -2.0, 0.0, 0.0));
    std::ignore = copy.tick(pushing(0.003)); // 1.5 N
    EXPECT_LT(copy.speed(), 0.0);
}

TEST(BaseAlgorithm, MovesABodyThatThisHandAlonePushesByItsForce)
{
    Copy copy;
    scene::World expected = paper_world();
    copy.hear(heard(false, -0.5, 0.05, 0.0)); // a force without touch does not count
    std::ignore = copy.tick(pushing(0.004));
    tick(expected, pushing(0.004));
    EXPECT_EQ(copy.world.hash(), expected.hash());
}

TEST(BaseAlgorithm, PutsABodyThatOnlyTheOtherHandTouchesWhereTheOtherSideHasIt)
{
    Copy copy;
    copy.hear(heard(true, -0.5, 0.05, 0.3));
    for (int i = 0; i < 5; ++i) { // held between messages
        EXPECT_FALSE(copy.tick(away).touching);
        EXPECT_EQ(copy.x(), 0.05);
        EXPECT_EQ(copy.speed(), 0.3);
    }
}

TEST(BaseAlgorithm, LetsATouchThatBeginsWithinATickCountInIt)
{
    Copy copy;
    scene::World expected = paper_world();
    copy.hear(heard(true, -0.5, 0.05, 0.3));
    const scene::HandInput coming = pushing(-0.0001, 0.3); // 0.3 mm of way, 0.1 mm away
    EXPECT_TRUE(copy.tick(coming).touching);
    tick(expected, coming, -0.5);
    EXPECT_EQ(copy.world.hash(), expected.hash());
}

TEST(BaseAlgorithm, TakesTheRemoteForceFadedWithItsAgeAndNeverMoreThanAContactExerts)
{
    Remote remote{{}};
    remote.update(heard(true, -1e30, 0.0, 0.0), start);
    const auto force_at = [&](double freshness) {
        look_when_fresh_by(freshness, remote);
        const Situation situation{
            .now = start, .others = {&remote, 1}, .remote = remote, .force_max_n = 3.3};
        return combined_remote(situation, {}).force.x();
    };
    EXPECT_NEAR(force_at(1.0), -3.3, 1e-12);
    EXPECT_NEAR(force_at(0.5), -1.65, 1e-12);
    EXPECT_EQ(force_at(0.0), 0.0);
}

TEST(BaseAlgorithm, TreatsAStaleRemoteAsNotTouching)
{
    Copy copy;
    scene::World expected = paper_world();
    copy.hear(heard(true, -0.5, 0.05, 0.0));
    std::ignore = copy.tick(away, 0.0);
    EXPECT_EQ(copy.x(), 0.0);
    tick(expected, away);
    std::ignore = copy.tick(pushing(0.004), 0.0);
    tick(expected, pushing(0.004));
    EXPECT_EQ(copy.world.hash(), expected.hash());
}

TEST(BaseAlgorithm, LetsABodyThatNobodyTouchesCoastFor200MsAndThenBlendsItWithin100Ms)
{
    Copy copy;
    scene::World expected = paper_world();
    std::ignore = copy.tick(pushing(0.003));
    tick(expected, pushing(0.003));
    copy.hear(heard(false, 0.0, 0.010, 0.0));
    for (int ms = 0; ms < 200; ++ms) {
        std::ignore = copy.tick(away);
        tick(expected, away);
        ASSERT_EQ(copy.world.hash(), expected.hash()) << ms;
    }
    tick(expected, away); // the blend begins at the body's present place
    const double from = expected.body(0).position.x();
    for (int ms = 0; ms <= 100; ++ms) {
        std::ignore = copy.tick(away);
        EXPECT_NEAR(copy.x(), from + 0.01 * ms * (0.010 - from), 1e-12) << ms;
    }
    std::ignore = copy.tick(away);
    EXPECT_EQ(copy.x(), 0.010);
}

TEST(BaseAlgorithm, LeavesTheLowerIdsBodyToItselfWhenNobodyTouches)
{
    Copy copy;
    copy.hear(heard(false, 0.0, 0.010, 0.0));
    for (int ms = 0; ms < 1000; ++ms) std::ignore = copy.tick(away, 1.0, false);
    EXPECT_EQ(copy.x(), 0.0);
}

TEST(BaseAlgorithm, DoesNotBlendToAWordThatIsStale)
{
    Copy copy;
    copy.hear(heard(false, 0.0, 0.010, 0.0));
    for (int ms = 0; ms < 1000; ++ms) std::ignore = copy.tick(away, 0.0);
    EXPECT_EQ(copy.x(), 0.0);
}

TEST(BaseAlgorithm, BreaksABlendOffWhenAHandTouchesAndWaitsAnewAfterwards)
{
    Copy copy;
    copy.hear(heard(false, 0.0, 0.010, 0.0));
    for (int ms = 0; ms < 250; ++ms) std::ignore = copy.tick(away);                    // halfway
    const scene::HandInput from_the_right{.position = {{copy.x() + 0.023, 0.0, 0.0}}}; // 1 N
    EXPECT_TRUE(copy.tick(from_the_right).touching);
    const double left_at = copy.x();
    EXPECT_NEAR(left_at, 0.005, 0.0005);
    for (int ms = 0; ms < 200; ++ms) std::ignore = copy.tick(away);
    EXPECT_LT(copy.x(), left_at); // coasted, not blended
}

TEST(Algorithms, HaveNames)
{
    for (const std::string_view name : algorithm_names) EXPECT_TRUE(algorithm_named(name));
    const auto unknown = algorithm_named("best");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().message, "unknown algorithm 'best': did you mean 'base'?");
}

} // namespace
} // namespace hapnet::peer::base_algorithm_test

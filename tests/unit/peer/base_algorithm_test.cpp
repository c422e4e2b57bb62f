// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Every branch of the paper's hybrid algorithm against ticks worked out by hand.
#include "peer/core/base_algorithm.hpp"

#include "peer/core/algorithm.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::peer {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};
const Scene scene = paper_scene();
// One tick of 1 ms under b = 10 N s/m with m = 0.1 kg: v' = exp(-0.1) v + (1 - exp(-0.1)) F / b.
const double kept = std::exp(-0.1);
const double gained = (1.0 - kept) / 10.0;
constexpr double rounding = 1e-15;

wire::State heard(bool touching, double force_x, double cube_x, double cube_speed)
{
    wire::State state;
    state.sequence = 1;
    state.touching = touching;
    state.contact_force = {{force_x, 0.0, 0.0}};
    state.body = wire::BodyState{};
    state.body->position = {{cube_x, 0.0, 0.0}};
    state.body->velocity = {{cube_speed, 0.0, 0.0}};
    return state;
}

/// A copy of the cube, the other side's word, and the algorithm between them.
class Copy {
public:
    void hear(const wire::State& state) { remote_.update(state, now); }

    void tick(double local_force_x, double freshness = 1.0, bool yields = true)
    {
        Touched local;
        local.touching = local_force_x != 0.0;
        local.on_cube = {{local_force_x, 0.0, 0.0}};
        const Situation situation{.now = now,
                                  .local = local,
                                  .remote = remote_,
                                  .freshness = freshness,
                                  .yields = yields};
        algorithm_.tick(cube, situation, remote_force(situation, scene.force_max_n));
        now += 1ms;
    }

    base::TimePoint now = start;
    Cube cube{scene, 1ms};

private:
    Remote remote_{{}};
    BaseAlgorithm algorithm_;
};

TEST(BaseAlgorithm, MovesACubeThatBothPushBySumOfTheForces)
{
    Copy copy;
    copy.hear(heard(true, -0.5, 0.05, 0.3)); // where it is over there does not matter now
    copy.tick(2.0);
    EXPECT_NEAR(copy.cube.velocity().x(), gained * 1.5, rounding);
    EXPECT_NEAR(copy.cube.position().x(), 1e-3 * gained * 1.5, rounding);
    copy.tick(2.0);
    EXPECT_NEAR(copy.cube.velocity().x(), (1.0 + kept) * gained * 1.5, rounding);
}

TEST(BaseAlgorithm, LetsTheStrongerDecideTheDirection)
{
    Copy copy;
    copy.hear(heard(true, -2.0, 0.0, 0.0));
    copy.tick(1.5);
    EXPECT_LT(copy.cube.velocity().x(), 0.0);
}

TEST(BaseAlgorithm, MovesACubeThatThisHandAlonePushesByItsForce)
{
    Copy copy;
    copy.hear(heard(false, -0.5, 0.05, 0.0)); // a force without touch does not count
    copy.tick(2.0);
    EXPECT_NEAR(copy.cube.velocity().x(), gained * 2.0, rounding);
}

TEST(BaseAlgorithm, PutsACubeThatOnlyTheOtherHandTouchesWhereTheOtherSideHasIt)
{
    Copy copy;
    copy.hear(heard(true, -0.5, 0.05, 0.3));
    for (int i = 0; i < 5; ++i) { // held between messages
        copy.tick(0.0);
        EXPECT_EQ(copy.cube.position().x(), 0.05);
        EXPECT_EQ(copy.cube.velocity().x(), 0.3);
    }
}

TEST(BaseAlgorithm, TakesTheRemoteForceFadedWithItsAgeAndNeverMoreThanAContactExerts)
{
    Remote remote{{}};
    remote.update(heard(true, -1e30, 0.0, 0.0), start);
    const auto force_at = [&](double freshness) {
        return remote_force({.now = start, .local = {}, .remote = remote, .freshness = freshness},
                            3.3)
            .x();
    };
    EXPECT_NEAR(force_at(1.0), -3.3, 1e-12);
    EXPECT_NEAR(force_at(0.5), -1.65, 1e-12);
    EXPECT_EQ(force_at(0.0), 0.0);
}

TEST(BaseAlgorithm, TreatsAStaleRemoteAsNotTouching)
{
    Copy copy;
    copy.hear(heard(true, -0.5, 0.05, 0.0));
    copy.tick(0.0, 0.0);
    EXPECT_EQ(copy.cube.position().x(), 0.0);
    copy.tick(2.0, 0.0);
    EXPECT_NEAR(copy.cube.velocity().x(), gained * 2.0, rounding);
}

TEST(BaseAlgorithm, LetsACubeThatNobodyTouchesCoastFor200MsAndThenBlendsItWithin100Ms)
{
    Copy copy;
    copy.tick(1.0);
    double speed = copy.cube.velocity().x();
    copy.hear(heard(false, 0.0, 0.010, 0.0));
    for (int ms = 0; ms < 200; ++ms) {
        copy.tick(0.0);
        speed *= kept;
        EXPECT_NEAR(copy.cube.velocity().x(), speed, rounding) << ms;
    }
    const double from = copy.cube.position().x();
    for (int ms = 0; ms <= 100; ++ms) {
        copy.tick(0.0);
        EXPECT_NEAR(copy.cube.position().x(), from + 0.01 * ms * (0.010 - from), 1e-12) << ms;
    }
    copy.tick(0.0);
    EXPECT_EQ(copy.cube.position().x(), 0.010);
}

TEST(BaseAlgorithm, LeavesTheLowerIdsCubeToItselfWhenNobodyTouches)
{
    Copy copy;
    copy.hear(heard(false, 0.0, 0.010, 0.0));
    for (int ms = 0; ms < 1000; ++ms) copy.tick(0.0, 1.0, false);
    EXPECT_EQ(copy.cube.position().x(), 0.0);
}

TEST(BaseAlgorithm, DoesNotBlendToAWordThatIsStale)
{
    Copy copy;
    copy.hear(heard(false, 0.0, 0.010, 0.0));
    for (int ms = 0; ms < 1000; ++ms) copy.tick(0.0, 0.0);
    EXPECT_EQ(copy.cube.position().x(), 0.0);
}

TEST(BaseAlgorithm, BreaksABlendOffWhenAHandTouchesAndWaitsAnewAfterwards)
{
    Copy copy;
    copy.hear(heard(false, 0.0, 0.010, 0.0));
    for (int ms = 0; ms < 250; ++ms) copy.tick(0.0); // halfway
    copy.tick(-1.0);
    const double left_at = copy.cube.position().x();
    EXPECT_NEAR(left_at, 0.005, 0.0005);
    for (int ms = 0; ms < 200; ++ms) copy.tick(0.0);
    EXPECT_LT(copy.cube.position().x(), left_at); // coasted, not blended
}

TEST(Algorithms, HaveNames)
{
    EXPECT_TRUE(algorithm_named("base"));
    const auto unknown = algorithm_named("best");
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().message, "'best' is not an algorithm; known: base");
}

} // namespace
} // namespace hapnet::peer

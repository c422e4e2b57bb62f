// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/unit/scene/collide/crowd.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::scene {
namespace {

using List = std::vector<std::pair<BodyId, BodyId>>;

template <typename Kind>
class NeighboursOf : public testing::Test {
protected:
    using Subject = Crowd<Kind::value>;
};
using Kinds = testing::Types<std::integral_constant<BroadPhase, BroadPhase::all_pairs>,
                             std::integral_constant<BroadPhase, BroadPhase::grid>>;
TYPED_TEST_SUITE(NeighboursOf, Kinds);

TYPED_TEST(NeighboursOf, AreThoseNextToEachOtherByTheirIds)
{
    typename TestFixture::Subject crowd{row_of_cubes(4, 0.0401)};
    EXPECT_EQ(crowd.pairs(), (List{{0, 1}, {1, 2}, {2, 3}}));
}

TYPED_TEST(NeighboursOf, AreNotLookedForWhileABodyStaysInItsBox)
{
    typename TestFixture::Subject crowd{row_of_cubes(4, 0.0401)};
    for (int tick = 0; tick < 100; ++tick) {
        crowd.place(1, {0.0401 + 0.00001 * tick, 0.0, 0.0}); // 1 mm: 5 % of the half edge
        crowd.pair_finder.update(crowd.bodies);
    }
    EXPECT_EQ(crowd.pair_finder.counts().renewed, 0U);
}

TYPED_TEST(NeighboursOf, AreLookedForAboutOnceInThirtyTicksOfFlight)
{
    typename TestFixture::Subject crowd{row_of_cubes(4, 1.0)};
    crowd.bodies.velocity.put(2, {2.0, 0.5, 0.0});
    for (int tick = 0; tick < 300; ++tick) {
        crowd.place(2, crowd.bodies.position.at(2) + crowd.bodies.velocity.at(2) * 1e-3);
        crowd.pair_finder.update(crowd.bodies);
    }
    EXPECT_GE(crowd.pair_finder.counts().renewed, 1U);
    EXPECT_LE(crowd.pair_finder.counts().renewed, 10U);
}

/// A bar along x, and a cube that the bar can only reach by rotation.
Description bar_below_a_cube()
{
    Description description = row_of_cubes(2, 0.0);
    description.bodies[0].half = {0.1, 0.01, 0.01};
    description.bodies[1].position = base::Position{{0.0, 0.09, 0.0}};
    return description;
}

TYPED_TEST(NeighboursOf, AreFoundByABodyThatTurnsSlowlyTowardsThem)
{
    typename TestFixture::Subject crowd{bar_below_a_cube()};
    EXPECT_EQ(crowd.pairs(), List{});
    for (int step = 1; step <= 50; ++step) {
        const double half_angle = 0.0157 * step; // up to a right angle
        crowd.bodies.orientation.put(crowd.bodies.slot_of[0],
                                     {std::cos(half_angle), 0.0, 0.0, std::sin(half_angle)});
        crowd.pair_finder.update(crowd.bodies);
    }
    EXPECT_EQ(crowd.pairs(), (List{{0, 1}}));
    EXPECT_GT(crowd.pair_finder.counts().renewed, 10U);
}

TYPED_TEST(NeighboursOf, AreFoundByABodyThatIsSpunUpAllAtOnce)
{
    typename TestFixture::Subject crowd{bar_below_a_cube()};
    crowd.bodies.set_angular_velocity(crowd.bodies.slot_of[0], {0.0, 0.0, 1000.0});
    crowd.pair_finder.update(crowd.bodies);
    EXPECT_EQ(crowd.pairs(), (List{{0, 1}}));
}

TYPED_TEST(NeighboursOf, KeepTheirContactsMemoryWhileTheyAreNear)
{
    typename TestFixture::Subject crowd{row_of_cubes(3, 0.0401)};
    crowd.pair_finder.pair(crowd.pair_finder.pairs()[1]).memory.torsion_impulse = 7.0;
    crowd.place(0, {5.0, 0.0, 0.0});
    crowd.place(1, {0.0375, 0.0, 0.0});
    crowd.pair_finder.update(crowd.bodies);
    ASSERT_EQ(crowd.pairs(), (List{{1, 2}}));
    EXPECT_GE(crowd.pair_finder.counts().renewed, 2U);
    EXPECT_EQ(crowd.pair_finder.pair(crowd.pair_finder.pairs()[0]).memory.torsion_impulse, 7.0);
}

TYPED_TEST(NeighboursOf, HaveForgottenEachOtherWhenTheyMeetAgain)
{
    typename TestFixture::Subject crowd{row_of_cubes(2, 0.0401)};
    crowd.pair_finder.pair(crowd.pair_finder.pairs()[0]).memory.torsion_impulse = 7.0;
    crowd.place(1, {5.0, 0.0, 0.0});
    crowd.pair_finder.update(crowd.bodies);
    EXPECT_EQ(crowd.pairs(), List{});
    crowd.place(1, {0.0401, 0.0, 0.0});
    crowd.pair_finder.update(crowd.bodies);
    ASSERT_EQ(crowd.pairs(), (List{{0, 1}}));
    EXPECT_EQ(crowd.pair_finder.pair(crowd.pair_finder.pairs()[0]).memory.torsion_impulse, 0.0);
}

TYPED_TEST(NeighboursOf, DoNotDependOnTheOrderInWhichTheyCame)
{
    const Description description = row_of_cubes(30, 0.0401);
    typename TestFixture::Subject fresh{description};
    typename TestFixture::Subject old{description};
    const base::RandomStream chance = base::Seed{1}.stream("order");
    for (std::uint64_t round = 0; round < 30; ++round) {
        const auto id = static_cast<BodyId>(chance.below(30, round));
        const glm::dvec3 home = old.bodies.position.at(id);
        old.place(id, home + glm::dvec3{0.0, 2.0, 0.0});
        old.pair_finder.update(old.bodies);
        old.place(id, home);
        old.pair_finder.update(old.bodies);
    }
    EXPECT_EQ(old.pairs(), fresh.pairs());
}

TYPED_TEST(NeighboursOf, AreNotListedWhileBothSleepAndKeepTheirMemory)
{
    typename TestFixture::Subject crowd{row_of_cubes(3, 0.0401)};
    crowd.pair_finder.pair(crowd.pair_finder.pairs()[0]).memory.torsion_impulse = 7.0;
    crowd.sleep(0);
    EXPECT_EQ(crowd.pairs(), (List{{0, 1}, {1, 2}}));
    crowd.sleep(1);
    EXPECT_EQ(crowd.pairs(), (List{{1, 2}}));
    crowd.sleep(2);
    EXPECT_EQ(crowd.pairs(), List{});
    crowd.pair_finder.update(crowd.bodies);
    crowd.wake(0);
    EXPECT_EQ(crowd.pairs(), (List{{0, 1}}));
    EXPECT_EQ(crowd.pair_finder.pairs_added().size(), 1U);
    EXPECT_EQ(crowd.pair_finder.pair(crowd.pair_finder.pairs()[0]).memory.torsion_impulse, 7.0);
}

TYPED_TEST(NeighboursOf, AreNeverTwoFixedBodies)
{
    Description description = row_of_cubes(4, 0.0401);
    for (const std::size_t fixed : {0U, 1U, 3U}) description.bodies[fixed].movable = false;
    typename TestFixture::Subject crowd{description};
    EXPECT_EQ(crowd.pairs(), (List{{1, 2}, {2, 3}}));
}

TYPED_TEST(NeighboursOf, ArePlanesOnlyWhenABodyIsNearOrBelow)
{
    Description description = row_of_cubes(3, 1.0);
    description.planes = {PlaneDescription{.name = "floor", .offset_m = -0.0201},
                          PlaneDescription{.name = "far", .offset_m = -1.0}};
    typename TestFixture::Subject crowd{description};
    EXPECT_EQ(crowd.plane_pairs(), (List{{0, 0}, {1, 0}, {2, 0}}));
    crowd.place(1, {1.0, 0.5, 0.0});
    crowd.place(2, {2.0, -3.0, 0.0});
    crowd.pair_finder.update(crowd.bodies);
    EXPECT_EQ(crowd.plane_pairs(), (List{{0, 0}, {2, 0}, {2, 1}}));
    crowd.sleep(2);
    EXPECT_EQ(crowd.plane_pairs(), (List{{0, 0}}));
}

TYPED_TEST(NeighboursOf, BeyondTheBoundAreLeftOutAndCountedAndFoundOnceThereIsRoom)
{
    typename TestFixture::Subject crowd{row_of_cubes(100, 1e-6)};
    EXPECT_EQ(crowd.pairs().size(), 3200U);
    EXPECT_GE(crowd.pair_finder.counts().pairs_left_out, 4950U - 3200U);
    for (BodyId id = 0; id < 100; ++id) crowd.place(id, {0.0401 * id, 0.0, 0.0});
    crowd.pair_finder.update(crowd.bodies);
    crowd.pair_finder.update(crowd.bodies);
    EXPECT_EQ(crowd.pairs().size(), 99U);
}

TYPED_TEST(NeighboursOf, AreAskedForOnceByAHandThatIsFarAway)
{
    typename TestFixture::Subject crowd{row_of_cubes(5, 0.1)};
    for (int tick = 0; tick < 100; ++tick) {
        const glm::dvec3 at{0.2, 0.5, 1e-5 * tick};
        EXPECT_TRUE(crowd.pair_finder.near_hand(0, {at, at, 0.005}).empty());
    }
    EXPECT_EQ(crowd.pair_finder.counts().hands_renewed, 1U);
    const glm::dvec3 near{0.2, 0.024, 0.0};
    const auto reached = crowd.pair_finder.near_hand(0, {near, near, 0.005});
    ASSERT_EQ(reached.size(), 1U);
    EXPECT_EQ(reached[0], 2U);
}

TYPED_TEST(NeighboursOf, OfAHandFollowTheBodiesThatComeAndGo)
{
    typename TestFixture::Subject crowd{row_of_cubes(3, 1.0)};
    const HandPath still{{0.0, 0.03, 0.0}, {0.0, 0.03, 0.0}, 0.005};
    ASSERT_EQ(crowd.pair_finder.near_hand(0, still).size(), 1U);
    crowd.place(0, {0.5, 0.0, 0.0});
    crowd.place(2, {0.03, 0.0, 0.0});
    crowd.place(1, {-0.03, 0.0, 0.0});
    crowd.pair_finder.update(crowd.bodies);
    const auto reached = crowd.pair_finder.near_hand(0, still);
    EXPECT_EQ((std::vector<BodyId>{reached.begin(), reached.end()}), (std::vector<BodyId>{1, 2}));
    EXPECT_EQ(crowd.pair_finder.counts().hands_renewed, 1U);
}

} // namespace
} // namespace hapnet::scene

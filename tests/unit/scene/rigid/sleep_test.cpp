// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/sleep.hpp"
#include "tests/unit/scene/collide/crowd.hpp"

#include <gtest/gtest.h>

namespace hapnet::scene::sleep_test {
namespace {

constexpr int rest_ticks = 100; // a tenth of a second

/// Bodies that sleep and wake, with contacts made by the tests.
template <BroadPhase broad_phase>
struct Sleepers : Crowd<broad_phase> {
    explicit Sleepers(const Description& description)
        : Crowd<broad_phase>{description}, sleep{this->config, this->bodies}
    {
        for (BodyId id = 0; id < this->bodies.movable; ++id) speed(id, 1.0);
    }
    void speed(BodyId id, double m_per_s)
    {
        this->bodies.velocity.put(this->bodies.slot_of[id], {m_per_s, 0.0, 0.0});
    }
    void still(BodyId id) { speed(id, 0.0); }
    void touch(BodyId a, BodyId b, double impulse)
    {
        for (const PairIndex i : this->pair_finder.pairs()) {
            Pair& pair = this->pair_finder.pair(i);
            if (pair.a != a || pair.b != b) continue;
            pair.memory.count = 1;
            pair.memory.normal_impulse[0] = impulse;
        }
    }
    void update(int count)
    {
        for (int i = 0; i < count; ++i) sleep.update(this->bodies, this->pair_finder, ++ticks);
    }
    [[nodiscard]] bool is_awake(BodyId id) const
    {
        return this->bodies.slot_of[id] < this->bodies.awake;
    }
    [[nodiscard]] std::string awake() const
    {
        std::string text;
        for (BodyId id = 0; id < this->bodies.movable; ++id) text += is_awake(id) ? 'a' : 's';
        return text;
    }

    Sleep sleep;
    std::uint64_t ticks = 0;
};

template <typename Kind>
class SleepOf : public ::testing::Test {
protected:
    using Subject = Sleepers<Kind::value>;
};
using Kinds = ::testing::Types<std::integral_constant<BroadPhase, BroadPhase::all_pairs>,
                               std::integral_constant<BroadPhase, BroadPhase::grid>>;
TYPED_TEST_SUITE(SleepOf, Kinds);

TYPED_TEST(SleepOf, ABodyComesAfterATenthOfASecondAtRestAndNotBefore)
{
    typename TestFixture::Subject crowd{row_of_cubes(3, 1.0)};
    crowd.still(1);
    crowd.update(rest_ticks - 1);
    EXPECT_EQ(crowd.awake(), "aaa");
    crowd.update(1);
    EXPECT_EQ(crowd.awake(), "asa");
}

TYPED_TEST(SleepOf, WhatCreepsBelowTheLimitStopsExactlyAndWhatIsFasterDoesNot)
{
    typename TestFixture::Subject crowd{row_of_cubes(3, 1.0)};
    crowd.speed(0, 1e-3); // limit: 0.1 * 9.81e-3 + 1e-3 * sqrt(9.81 * 0.04) = 1.61e-3
    crowd.speed(1, 2e-3);
    crowd.still(2);
    crowd.bodies.set_angular_velocity(2, {0.0, 0.1, 0.0}); // corners at 3.5e-3
    crowd.update(rest_ticks);
    EXPECT_EQ(crowd.awake(), "saa");
    EXPECT_EQ(crowd.bodies.velocity.at(crowd.bodies.slot_of[0]), glm::dvec3{0.0});
}

TYPED_TEST(SleepOf, AnIslandWaitsForTheLastOfItsBodies)
{
    typename TestFixture::Subject crowd{row_of_cubes(4, 0.0401)};
    crowd.touch(0, 1, 1e-3);
    crowd.touch(1, 2, 1e-3);
    crowd.touch(2, 3, 0.0); // near, without a load
    for (BodyId id : {0U, 1U, 3U}) crowd.still(id);
    crowd.update(rest_ticks);
    EXPECT_EQ(crowd.awake(), "aaas");
    crowd.still(2);
    crowd.update(rest_ticks);
    EXPECT_EQ(crowd.awake(), "ssss");
    EXPECT_TRUE(crowd.pair_finder.pairs().empty());
}

TYPED_TEST(SleepOf, FixedBodiesConnectNothing)
{
    Description description = row_of_cubes(3, 0.0401);
    description.bodies[1].movable = false;
    typename TestFixture::Subject crowd{description};
    crowd.touch(0, 1, 1e-3);
    crowd.touch(1, 2, 1e-3);
    crowd.still(0);
    crowd.speed(2, 1.0);
    crowd.update(rest_ticks);
    EXPECT_FALSE(crowd.is_awake(0));
    EXPECT_TRUE(crowd.is_awake(2));
}

TYPED_TEST(SleepOf, WakingOneWakesWhatItTouchesAndNobodyElseAndContactsKeepTheirImpulses)
{
    typename TestFixture::Subject crowd{row_of_cubes(5, 0.0401)};
    for (BodyId id = 0; id < 3; ++id) crowd.touch(id, id + 1, 1e-3 * (id + 1));
    for (BodyId id = 0; id < 5; ++id) crowd.still(id);
    crowd.update(rest_ticks);
    ASSERT_EQ(crowd.awake(), "sssss");
    crowd.sleep.wake(2, crowd.bodies, crowd.pair_finder);
    EXPECT_EQ(crowd.awake(), "aaaas");
    ASSERT_EQ(crowd.pair_finder.pairs().size(), 4U);
    for (BodyId id = 0; id < 3; ++id) {
        const Pair& pair = crowd.pair_finder.pair(crowd.pair_finder.pairs()[id]);
        EXPECT_EQ(pair.memory.normal_impulse[0], 1e-3 * (id + 1));
    }
}

TYPED_TEST(SleepOf, EndsForWhatAMovingBodyTouchesAndNotForWhatOneAtRestDoes)
{
    typename TestFixture::Subject crowd{row_of_cubes(4, 0.0401)};
    crowd.touch(0, 1, 1e-3);
    for (BodyId id = 0; id < 4; ++id) crowd.still(id);
    crowd.update(rest_ticks);
    ASSERT_EQ(crowd.awake(), "ssss");
    crowd.sleep.wake(2, crowd.bodies, crowd.pair_finder);
    const auto touching = [&](PairIndex index) { return crowd.pair_finder.pair(index).a != 2; };
    crowd.still(2);
    crowd.update(1);
    EXPECT_FALSE(crowd.sleep.wake_touched(crowd.bodies, crowd.pair_finder, touching));
    crowd.speed(2, 0.1);
    crowd.update(1);
    EXPECT_TRUE(crowd.sleep.wake_touched(crowd.bodies, crowd.pair_finder, touching));
    EXPECT_EQ(crowd.awake(), "aaas");
    EXPECT_FALSE(crowd.sleep.wake_touched(crowd.bodies, crowd.pair_finder, touching));
}

TYPED_TEST(SleepOf, EndsAlongAWholeRowInOneTick)
{
    typename TestFixture::Subject crowd{row_of_cubes(12, 0.0401)};
    for (BodyId id = 0; id < 12; ++id) crowd.still(id);
    crowd.update(rest_ticks);
    ASSERT_EQ(crowd.awake(), "ssssssssssss");
    crowd.sleep.wake(11, crowd.bodies, crowd.pair_finder);
    crowd.speed(11, 0.1);
    int looks = 0;
    const auto touching = [&](PairIndex /*index*/) { return ++looks > 0; };
    EXPECT_TRUE(crowd.sleep.wake_touched(crowd.bodies, crowd.pair_finder, touching));
    EXPECT_EQ(crowd.awake(), "aaaaaaaaaaaa");
    EXPECT_EQ(looks, 11); // each pair once
}

TYPED_TEST(SleepOf, DoesNotComeToABodyThatIsKeptAwake)
{
    typename TestFixture::Subject crowd{row_of_cubes(2, 1.0)};
    for (BodyId id : {0U, 1U}) crowd.still(id);
    for (int tick = 0; tick < 2 * rest_ticks; ++tick) {
        crowd.sleep.keep_awake(crowd.bodies, 1);
        crowd.update(1);
    }
    EXPECT_EQ(crowd.awake(), "sa");
}

TYPED_TEST(SleepOf, IsNotWhenItIsOff)
{
    typename TestFixture::Subject crowd{row_of_cubes(2, 1.0)};
    crowd.config.sleeping = false;
    crowd.sleep = Sleep{crowd.config, crowd.bodies};
    for (BodyId id : {0U, 1U}) crowd.still(id);
    crowd.update(3 * rest_ticks);
    EXPECT_EQ(crowd.awake(), "aa");
}

} // namespace
} // namespace hapnet::scene::sleep_test

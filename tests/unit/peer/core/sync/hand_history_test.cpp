// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/hand_history.hpp"

#include "peer/core/sync/age_quantile.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::peer::hand_history_test {
namespace {

using namespace std::chrono_literals;

HandSample sample(double x_m, double speed_m_per_s = 0.0)
{
    return {{x_m, 0.0, 0.0}, {speed_m_per_s, 0.0, 0.0}, true, false};
}

TEST(HandHistory, FindsTheCubicBetweenTwoThatAreKnown)
{
    // x = t^3 - 2 t^2 + 3 t in ticks of 1 ms: interpolation of a cubic is exact everywhere.
    const auto x = [](double t) { return 1e-6 * (t * t * t - 2.0 * t * t + 3.0 * t); };
    const auto v = [](double t) { return 1e-3 * (3.0 * t * t - 4.0 * t + 3.0); };
    HandHistory history;
    history.add(10, sample(x(0.0), v(0.0)));
    history.add(50, sample(x(40.0), v(40.0)));
    for (int t = 0; t <= 40; ++t) {
        const HandSample found = history.at(10 + t, 1ms);
        EXPECT_NEAR(found.place.x, x(t), 1e-15) << t;
        EXPECT_NEAR(found.velocity.x, v(t), 1e-12) << t;
    }
}

TEST(HandHistory, HoldsTheNewestAndKnowsNothingBeforeTheFirst)
{
    HandHistory history;
    EXPECT_FALSE(history.at(3, 1ms).present);
    history.add(10, sample(0.1, 1.0));
    EXPECT_FALSE(history.at(9, 1ms).present);
    const HandSample held = history.at(20, 1ms);
    EXPECT_TRUE(held.present);
    EXPECT_EQ(held.place.x, 0.1);
    EXPECT_EQ(held.velocity.x, 0.0);
}

TEST(HandHistory, TakesEachTickOnceAndForgetsWhatIsTooOld)
{
    HandHistory history;
    EXPECT_TRUE(history.add(5, sample(0.1)));
    EXPECT_FALSE(history.add(5, sample(0.2)));
    EXPECT_EQ(history.at(5, 1ms).place.x, 0.1);
    EXPECT_TRUE(history.add(5 + HandHistory::ticks_max, sample(0.3)));
    EXPECT_FALSE(history.knows(5));
    EXPECT_FALSE(history.add(5, sample(0.1)));
    EXPECT_FALSE(history.add(-1, sample(0.1)));
}

TEST(HandHistory, HasTheSameBitsOfTheOwnHandAndOfItsMessage)
{
    const scene::HandInput input{.position = {{0.1234567890123, 1.0 / 3.0, -0.7}},
                                 .velocity = {{1e-9, 0.3, 0.1}}};
    wire::State state;
    state.sequence = 1;
    state.hip = input.position;
    state.hip_velocity = input.velocity;
    const auto message = wire::decode(wire::encode(state).bytes());
    ASSERT_TRUE(message);
    const HandSample heard = HandSample::of(std::get<wire::State>(*message));
    const HandSample own = HandSample::of(input);
    EXPECT_EQ(heard.place, own.place);
    EXPECT_EQ(heard.velocity, own.velocity);
    EXPECT_TRUE(heard.present);
    EXPECT_FALSE(HandSample::of(wire::State{}).present); // no hand holds the device
}

TEST(SessionTicks, CountWhereClocksAreNotExact)
{
    SessionTicks ticks;
    EXPECT_EQ(ticks.number(0, 7ms, 1ms), 0);
    EXPECT_EQ(ticks.number(1, -20ms, 1ms), 1);
    EXPECT_EQ(ticks.number(1000, 1049ms, 1ms), 1000);
}

TEST(SessionTicks, NumberWhoJoinsLateByTheClockAndCountOnFromThere)
{
    SessionTicks ticks;
    EXPECT_EQ(ticks.number(0, 312ms + 400us, 1ms), 312);
    EXPECT_EQ(ticks.number(1, 330ms, 1ms), 313);
    EXPECT_EQ(ticks.number(100, 500ms, 1ms), 500); // it has again missed some
}

TEST(AgeQuantile, IsTheAgeThatAShareDoesNotExceed)
{
    AgeQuantile ages;
    EXPECT_EQ(ages.value(0.99), 0);
    for (int age = 1; age <= 100; ++age) ages.add(age);
    EXPECT_EQ(ages.value(0.99), 99);
    EXPECT_EQ(ages.value(0.5), 50);
    EXPECT_EQ(ages.value(1.0), 100);
}

TEST(AgeQuantile, ForgetsWithinItsMemory)
{
    AgeQuantile ages;
    ages.add(200);
    for (int ms = 0; ms < 5000; ++ms) ages.pass(1ms, 5s);
    EXPECT_EQ(ages.value(0.99), 0);
}

} // namespace
} // namespace hapnet::peer::hand_history_test

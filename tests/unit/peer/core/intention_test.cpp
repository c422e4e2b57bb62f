// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/intention.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::peer::intention_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};
constexpr HandDynamics hand{.damping_ns_per_m = 5.0, .stiffness_n_per_m = 200.0, .friction_n = 0.2};

Intention::Sample at_rest(double hip_m, double force_n)
{
    return {.hip = {{hip_m, 0.0, 0.0}}, .velocity = {}, .force = {{force_n, 0.0, 0.0}}};
}

/// The intention after half a second of the same sample.
Intention after(const Intention::Sample& sample, const HandDynamics& dynamics)
{
    Intention intention{dynamics};
    for (int ms = 0; ms < 500; ++ms) intention.add(sample, start + ms * 1ms);
    return intention;
}

TEST(Intention, IsBehindTheForceThatHoldsTheHandOff)
{
    HandDynamics smooth = hand;
    smooth.friction_n = 0.0;
    // 1 N to the left at 200 N/m: the intention is 5 mm farther right.
    EXPECT_NEAR(after(at_rest(0.010, -1.0), smooth).place().x(), 0.015, 1e-9);
    EXPECT_NEAR(after(at_rest(0.010, 0.0), smooth).place().x(), 0.010, 1e-9);
}

TEST(Intention, OfAHandThatMovesEvenlyIsAheadByDampingAndFriction)
{
    Intention intention{hand};
    const double speed = 0.05;
    double x = 0.0;
    for (int ms = 0; ms < 500; ++ms) {
        x = speed * 1e-3 * ms;
        intention.add({{{x, 0.0, 0.0}}, {{speed, 0.0, 0.0}}, {}}, start + ms * 1ms);
    }
    EXPECT_NEAR(intention.place().x(), x + (5.0 * speed + 0.2) / 200.0, 1e-7);
    EXPECT_NEAR(intention.velocity().x(), speed, 1e-5);
}

TEST(Intention, OfAHandThatSticksDoesNotMoveWithAForceThatFrictionBears)
{
    Intention intention{hand};
    for (int ms = 0; ms < 500; ++ms) intention.add(at_rest(0.0, 0.0), start + ms * 1ms);
    for (int ms = 500; ms < 1000; ++ms) intention.add(at_rest(0.0, -0.15), start + ms * 1ms);
    EXPECT_NEAR(intention.place().x(), 0.0, 1e-9); // 0.15 N would be 0.75 mm, within 1 mm
    for (int ms = 1000; ms < 1500; ++ms) intention.add(at_rest(0.0, -0.6), start + ms * 1ms);
    EXPECT_NEAR(intention.place().x(), (0.6 - 0.2) / 200.0, 1e-7);
}

TEST(Intention, StartsAnewAfterAHandThatWasNotThere)
{
    Intention intention = after(at_rest(0.010, -1.0), hand);
    intention.reset();
    EXPECT_FALSE(intention.is_known());
    intention.add(at_rest(-0.030, 0.0), start + 1s);
    EXPECT_TRUE(intention.is_known());
    EXPECT_EQ(intention.place().x(), -0.030);
    EXPECT_EQ(intention.velocity().x(), 0.0);
}

TEST(HandModelOf, SaysWhatIsKnownOfTheDeviceAndNothingOfThePerson)
{
    device::Capabilities capabilities;
    capabilities.friction_n = 0.26;
    EXPECT_EQ(hand_model_of(capabilities), (wire::HandModel{.friction = 0.26F}));
    EXPECT_EQ(hand_model_of({}), wire::HandModel{});
}

} // namespace
} // namespace hapnet::peer::intention_test

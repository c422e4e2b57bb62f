// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/page/page_hand.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <limits>
#include <memory>

namespace hapnet::device {

namespace {

using namespace std::chrono_literals;

class ThePageHand : public testing::Test {
protected:
    void begin_session() { hand.on_cue({.start = now, .hands_on = 30s, .seed = base::Seed{1}}); }
    Sample tick()
    {
        now += 1ms;
        return hand.read(now);
    }
    /// A page sends a place every 20 ms while the person holds the hand.
    Sample hold(const base::Position& place, int ticks)
    {
        Sample sample;
        for (int i = 0; i < ticks; ++i) {
            if (i % 20 == 0) wishes->put(HandWish{place});
            sample = tick();
        }
        return sample;
    }

    std::shared_ptr<HandWishes> wishes = std::make_shared<HandWishes>();
    PageHand hand{wishes};
    base::TimePoint now{1000s};
};

TEST_F(ThePageHand, IsInNoHandBeforeASessionHasAStart)
{
    wishes->put(HandWish{{{0.1, 0.0, 0.0}}});
    const Sample sample = tick();
    EXPECT_TRUE(sample.docked);
    EXPECT_EQ(sample.hip, base::Position{PageHand::rest_m});
    begin_session();
    EXPECT_TRUE(tick().docked) << "a place from before the session moves nothing";
}

TEST_F(ThePageHand, GoesToThePlaceAndStaysThereWhileItIsHeld)
{
    begin_session();
    const base::Position place{{0.01, 0.02, -0.03}};
    const Sample sample = hold(place, 1000);
    EXPECT_EQ(sample.hip, place);
    EXPECT_FALSE(sample.docked);
    EXPECT_FALSE(sample.gripping);
}

TEST_F(ThePageHand, IsNeverFasterThanAMetreASecond)
{
    begin_session();
    base::Position before{PageHand::rest_m};
    for (int i = 0; i < 400; ++i) {
        if (i % 17 == 0) wishes->put(HandWish{{{i % 2 == 0 ? -0.2 : 0.2, 0.1, 0.2}}});
        const Sample sample = tick();
        EXPECT_LE(base::norm(sample.hip - before), 0.001 + 1e-12) << "tick " << i;
        before = sample.hip;
    }
}

TEST_F(ThePageHand, GoesEvenlyBetweenTwoPlaces)
{
    begin_session();
    (void)hold({{0.0, 0.0, 0.0}}, 400); // there, and last heard of 20 ms ago
    wishes->put(HandWish{{{0.010, 0.0, 0.0}}});
    for (int i = 1; i <= 20; ++i) {
        EXPECT_NEAR(tick().hip.x(), 0.0005 * i, 1e-12) << "tick " << i;
    }
}

TEST_F(ThePageHand, IsLetGoAfter250MillisecondsWithoutAPlaceAndNotANanosecondEarlier)
{
    begin_session();
    wishes->put(HandWish{{{0.0, 0.0, 0.0}}});
    (void)tick();
    const base::TimePoint heard = now;
    EXPECT_FALSE(hand.read(heard + 250ms).docked);
    EXPECT_TRUE(hand.read(heard + 250ms + 1ns).docked);
    const base::Position there = hand.read(heard + 251ms).hip;
    EXPECT_EQ(hand.read(heard + 900ms).hip, there) << "a hand that is let go stays";
}

TEST_F(ThePageHand, IsLetGoAtOnceWhenThePersonLetsGo)
{
    begin_session();
    const base::Position there = hold({{0.0, 0.0, 0.0}}, 30).hip;
    wishes->put(std::nullopt);
    const Sample sample = tick();
    EXPECT_TRUE(sample.docked);
    EXPECT_EQ(sample.hip, there) << "it stays where it was let go";
    EXPECT_FALSE(hold({{0.0, 0.0, 0.0}}, 1).docked) << "and is taken again";
}

TEST_F(ThePageHand, GripsWhileThePersonSaysSoAndHoldsIt)
{
    begin_session();
    wishes->put(HandWish{.place = {{0.0, 0.0, 0.0}}, .grips = true});
    EXPECT_TRUE(tick().gripping);
    EXPECT_TRUE(tick().gripping) << "until it is told otherwise";
    wishes->put(HandWish{.place = {{0.0, 0.0, 0.0}}, .grips = false});
    EXPECT_FALSE(tick().gripping);
    wishes->put(HandWish{.place = {{0.0, 0.0, 0.0}}, .grips = true});
    EXPECT_TRUE(tick().gripping);
    wishes->put(std::nullopt);
    EXPECT_FALSE(tick().gripping);
}

TEST_F(ThePageHand, DoesNotJumpAfterAStallOfTheLoop)
{
    begin_session();
    wishes->put(HandWish{{{0.2, 0.0, 0.0}}});
    const base::Position before = tick().hip;
    now += 200ms;
    EXPECT_LE(base::norm(hand.read(now).hip - before), 0.020 + 1e-12);
}

TEST(PagePlace, HasThreeCoordinatesWithinReach)
{
    EXPECT_EQ(parse_page_place(0.1, -0.25, 0.25), (base::Position{{0.1, -0.25, 0.25}}));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {0.2501, -0.2501, 1e300, nan, infinity, -infinity}) {
        EXPECT_EQ(parse_page_place(bad, 0.0, 0.0).error().message,
                  "\"x\" must be a number of metres from -0.25 to 0.25");
        EXPECT_FALSE(parse_page_place(0.0, bad, 0.0));
        EXPECT_FALSE(parse_page_place(0.0, 0.0, bad));
    }
}

} // namespace

} // namespace hapnet::device

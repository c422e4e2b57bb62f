// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/director.hpp"

#include <chrono>
#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <variant>

namespace hapnet::emulator::director_test {
namespace {

using namespace std::chrono_literals;
using base::Duration;

const base::TimePoint start{100s};

Variation constant(Duration value) { return {ConstantLaw{value}, {}}; }

Patch delay_of(Duration value)
{
    Patch patch;
    patch.delay = constant(value);
    return patch;
}

Patch loss_of(double share)
{
    Patch patch;
    patch.loss = std::vector<LossLaw>{RandomLoss{base::Probability::from_fraction(share).value()}};
    return patch;
}

Duration delay_in(const Conditions& conditions)
{
    return std::get<ConstantLaw>(conditions.delay.law).value;
}

/// 160 ms in both directions.
Profile plain()
{
    Profile profile;
    profile.name = "plain";
    profile.seed = base::Seed{42};
    profile.path.up.delay = constant(160ms);
    profile.path.down.delay = constant(160ms);
    return profile;
}

/// 160 ms; up 300 ms from 10 s, up 10 ms from 20 s.
Profile stepped()
{
    Profile profile = plain();
    profile.name = "stepped";
    profile.timeline = {{10s, 0ns, delay_of(300ms), {}}, {20s, 0ns, delay_of(10ms), {}}};
    return profile;
}

Set up(Duration delay, std::optional<Duration> lasting = std::nullopt)
{
    return {delay_of(delay), {}, lasting};
}

TEST(Director, HoldsItsProfileFromTheBeginning)
{
    const Director director{plain(), start};
    EXPECT_EQ(director.path(), plain().path);
    EXPECT_EQ(director.generation(), 1U);
    EXPECT_EQ(director.next_change(), std::nullopt);
}

TEST(Director, FollowsTheTimelineToTheNanosecond)
{
    Director director{stepped(), start};
    EXPECT_EQ(director.next_change(), start + 10s);
    EXPECT_FALSE(director.advance(start + 10s - 1ns));
    EXPECT_TRUE(director.advance(start + 10s));
    EXPECT_EQ(delay_in(director.path().up), 300ms);
    EXPECT_EQ(delay_in(director.path().down), 160ms);
    EXPECT_EQ(director.generation(), 2U);
    EXPECT_EQ(director.next_change(), start + 20s);
    EXPECT_TRUE(director.advance(start + 25s));
    EXPECT_EQ(delay_in(director.path().up), 10ms);
    EXPECT_EQ(director.next_change(), std::nullopt);
}

TEST(Director, LetsASettingByHandWinOverTheProfileAtOnce)
{
    Director director{plain(), start};
    ASSERT_TRUE(director.apply(up(80ms), start + 1s));
    EXPECT_EQ(delay_in(director.path().up), 80ms);
    EXPECT_EQ(delay_in(director.path().down), 160ms);
    EXPECT_EQ(director.generation(), 2U);
}

TEST(Director, LetsTheNextStepOfTheSameSettingWinOverTheOneByHand)
{
    Director director{stepped(), start};
    ASSERT_TRUE(director.apply(up(80ms), start + 1s));
    EXPECT_TRUE(director.advance(start + 10s));
    EXPECT_EQ(delay_in(director.path().up), 300ms);
    EXPECT_TRUE(director.overrides().empty());
}

TEST(Director, KeepsASettingByHandOverStepsOfOtherSettings)
{
    Director director{stepped(), start};
    ASSERT_TRUE(director.apply(Set{loss_of(0.5), {}, {}}, start + 1s));
    director.advance(start + 30s);
    EXPECT_EQ(director.path().up.loss.size(), 1U);
    EXPECT_EQ(delay_in(director.path().up), 10ms);
}

TEST(Director, EndsASettingByHandAtAStepThatOnlyRepeatsTheProfile)
{
    Profile profile = plain();
    profile.timeline = {{10s, 0ns, delay_of(160ms), {}}};
    Director director{profile, start};
    ASSERT_TRUE(director.apply(up(80ms), start + 1s));
    EXPECT_EQ(director.next_change(), start + 10s);
    EXPECT_TRUE(director.advance(start + 10s));
    EXPECT_EQ(delay_in(director.path().up), 160ms);
}

TEST(Director, RestoresWhatWouldHoldWithoutASettingMadeForATime)
{
    Director director{plain(), start};
    ASSERT_TRUE(director.apply(up(80ms), start + 1s));
    ASSERT_TRUE(director.apply(up(500ms, 30s), start + 2s));
    EXPECT_EQ(delay_in(director.path().up), 500ms);
    EXPECT_EQ(director.next_change(), start + 32s);
    EXPECT_FALSE(director.advance(start + 32s - 1ns));
    EXPECT_TRUE(director.advance(start + 32s));
    EXPECT_EQ(delay_in(director.path().up), 80ms);
    EXPECT_EQ(director.generation(), 4U);
}

TEST(Director, RestoresWhatTheTimelineSaysByThen)
{
    Director director{stepped(), start};
    ASSERT_TRUE(director.apply(up(80ms, 5s), start + 11s));
    director.advance(start + 16s);
    EXPECT_EQ(delay_in(director.path().up), 300ms);
}

TEST(Director, DropsASettingForATimeThatAnotherForGoodCovers)
{
    Director director{plain(), start};
    ASSERT_TRUE(director.apply(up(80ms, 30s), start));
    ASSERT_TRUE(director.apply(up(90ms), start + 1s));
    EXPECT_EQ(director.overrides().size(), 1U);
    director.advance(start + 60s);
    EXPECT_EQ(delay_in(director.path().up), 90ms);
}

TEST(Director, HoldsABoundedNumberOfSettingsMadeForATime)
{
    Director director{plain(), start};
    for (std::size_t i = 0; i < Director::overrides_max; ++i) {
        ASSERT_TRUE(director.apply(up(1ms, 100s - i * 1s), start));
    }
    const auto refused = director.apply(up(2ms, 1s), start);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("64"), std::string::npos);
    EXPECT_EQ(director.overrides().size(), Director::overrides_max);
    EXPECT_TRUE(director.apply(up(2ms), start)) << "one for good covers them all";
    EXPECT_EQ(director.overrides().size(), 1U);
}

TEST(Director, CountsTheTimelineOfAnAppliedProfileFromThen)
{
    Director director{plain(), start};
    ASSERT_TRUE(director.apply(up(80ms), start));
    ASSERT_TRUE(director.apply(Apply{stepped()}, start + 50s));
    EXPECT_EQ(delay_in(director.path().up), 160ms);
    EXPECT_EQ(director.position(), 0s);
    EXPECT_EQ(director.next_change(), start + 60s);
    EXPECT_TRUE(director.overrides().empty());
}

TEST(Director, KeepsTheSeedOfTheRunWhateverIsApplied)
{
    Director director{plain(), start};
    Profile other = stepped();
    other.seed = base::Seed{7};
    ASSERT_TRUE(director.apply(Apply{other}, start));
    EXPECT_EQ(director.remaining().seed, plain().seed);
}

TEST(Director, ChangesNothingWhenTheSameProfileIsAppliedAgain)
{
    Director director{stepped(), start};
    ASSERT_TRUE(director.apply(Apply{plain()}, start + 1s));
    EXPECT_EQ(director.generation(), 2U) << "the conditions are the same, the plan is not";
    ASSERT_TRUE(director.apply(Apply{plain()}, start + 2s));
    EXPECT_EQ(director.generation(), 2U);
    EXPECT_EQ(director.path(), plain().path);
}

TEST(Director, ReturnsOnResetToWhatWouldHoldIfNobodyHadChangedAnything)
{
    Director director{stepped(), start};
    Director untouched{stepped(), start};
    ASSERT_TRUE(director.apply(Apply{plain()}, start + 1s));
    ASSERT_TRUE(director.apply(up(80ms), start + 2s));
    ASSERT_TRUE(director.apply(Reset{}, start + 12s));
    untouched.advance(start + 12s);
    EXPECT_EQ(director.path(), untouched.path());
    EXPECT_EQ(director.next_change(), start + 20s);
    EXPECT_EQ(director.script().profile(), stepped());
}

TEST(Director, FollowsARampInSmallSteps)
{
    Profile profile = plain();
    profile.timeline = {{10s, 100ms, delay_of(260ms), {}}};
    Director director{profile, start};
    director.advance(start + 10s + 50ms);
    EXPECT_EQ(delay_in(director.path().up), 210ms);
    director.advance(start + 11s);
    EXPECT_EQ(delay_in(director.path().up), 260ms);
    EXPECT_EQ(director.next_change(), std::nullopt);
}

TEST(Director, LetsASettingByHandWinOverARampThatIsUnderWay)
{
    Profile profile = plain();
    profile.timeline = {{10s, 100ms, delay_of(260ms), {}}};
    Director director{profile, start};
    ASSERT_TRUE(director.apply(up(1ms), start + 10s + 50ms));
    director.advance(start + 20s);
    EXPECT_EQ(delay_in(director.path().up), 1ms);
}

/// Expects that applying the remaining settings changes nothing, now and later.
void expect_remaining_is_faithful(Director director, Duration end)
{
    const auto begin = director.now();
    Director other{director.remaining(), begin};
    for (auto time = Duration{0}; time < end; time += end / 20) {
        director.advance(begin + time);
        other.advance(begin + time);
        EXPECT_EQ(other.path(), director.path()) << time.count();
    }
}

TEST(Director, SaysWhatRemainsInAProfileThatChangesNothingWhenApplied)
{
    Profile profile = stepped();
    profile.timeline.push_back({30s, 10s, delay_of(110ms), delay_of(60ms)});
    for (const Duration now : {0s, 10s, 15s, 25s, 30s, 35s, 45s}) {
        Director director{profile, start};
        director.advance(start + now);
        expect_remaining_is_faithful(director, 60s);
        ASSERT_TRUE(director.apply(up(80ms), start + now));
        expect_remaining_is_faithful(director, 60s);
        Patch spread;
        spread.delay = Variation{NormalLaw{50ms, 5ms}, {}};
        ASSERT_TRUE(director.apply(Set{spread, loss_of(0.1), {}}, start + now));
        expect_remaining_is_faithful(director, 60s);
    }
}

} // namespace
} // namespace hapnet::emulator::director_test

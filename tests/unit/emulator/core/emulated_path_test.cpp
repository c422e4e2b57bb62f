// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/emulated_path.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <gtest/gtest.h>
#include <tuple>
#include <variant>

namespace hapnet::emulator::emulated_path_test {
namespace {

using namespace std::chrono_literals;
using base::Duration;

const base::TimePoint start{100s};

Patch delay_of(Duration value)
{
    Patch patch;
    patch.delay = Variation{ConstantLaw{value}, {}};
    return patch;
}

/// Steps up to 20 ms at 1 s, and by a ramp from 2 s to 3 s up to 50 ms.
Profile stepped()
{
    Profile profile;
    profile.path.up.delay = Variation{ConstantLaw{10ms}, {}};
    profile.timeline = {{1s, 0ns, delay_of(20ms), {}}, {2s, 1s, delay_of(50ms), {}}};
    return profile;
}

EmulatedPath path_of(const Profile& profile)
{
    return {profile, {.start = start, .limits = {.datagrams_max = 16}}};
}

Duration delay_in(const Patch& patch) { return std::get<ConstantLaw>(patch.delay->law).value; }

void feed(EmulatedPath& path, base::TimePoint now)
{
    static constexpr std::array<std::byte, 4> bytes{};
    std::ignore = path.on_packet(Direction::up, bytes, now);
}

TEST(EmulatedPath, NotesNoChangeWhereNothingChanges)
{
    EmulatedPath path = path_of({});
    feed(path, start + 1s);
    path.advance(start + 1h);
    EXPECT_TRUE(path.changes().entries().empty());
}

TEST(EmulatedPath, NotesAStepOfTheTimelineWithTheFirstDatagramThatMeetsIt)
{
    EmulatedPath path = path_of(stepped());
    feed(path, start);
    feed(path, start + 1s - 1ns);
    feed(path, start + 1s);
    ASSERT_EQ(path.changes().entries().size(), 1U);
    const ConditionChange& change = path.changes().entries().front();
    EXPECT_EQ(change.generation, 2U);
    EXPECT_EQ(change.elapsed, 1s);
    EXPECT_EQ(change.effective_up, 2U);
    EXPECT_EQ(change.effective_down, 0U);
    EXPECT_EQ(change.by, ChangeCause::timeline);
    EXPECT_EQ(delay_in(change.patch(Direction::up)), 20ms);
    EXPECT_EQ(change.patch(Direction::down), Patch{});
}

TEST(EmulatedPath, NotesTheFirstAndTheLastStepOfARamp)
{
    EmulatedPath path = path_of(stepped());
    for (Duration at = 0ms; at <= 4s; at += 1ms) path.advance(start + at);
    const auto& changes = path.changes().entries();
    ASSERT_EQ(changes.size(), 3U);
    EXPECT_EQ(changes[1].elapsed, 2001ms);
    EXPECT_EQ(changes[1].generation, 3U);
    EXPECT_EQ(changes[2].elapsed, 3s);
    EXPECT_EQ(changes[2].generation, path.director().generation());
    EXPECT_EQ(delay_in(changes[2].patch(Direction::up)), 50ms);
    EXPECT_EQ(changes[2].by, ChangeCause::timeline);
}

TEST(EmulatedPath, NotesWhatIsSetByHandAndItsEnd)
{
    EmulatedPath path = path_of({});
    ASSERT_TRUE(path.apply(Set{{}, delay_of(5ms), 2s}, start + 1s));
    path.advance(start + 10s);
    const auto& changes = path.changes().entries();
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes[0].by, ChangeCause::hand);
    EXPECT_EQ(delay_in(changes[0].patch(Direction::down)), 5ms);
    EXPECT_EQ(changes[1].by, ChangeCause::hand);
    EXPECT_EQ(delay_in(changes[1].patch(Direction::down)), 0ms);
    EXPECT_FALSE(changes[1].patch(Direction::up).delay);
}

TEST(EmulatedPath, NotesAStepThatIsDueWhenSomethingIsSetAsTheTimelinesOwn)
{
    EmulatedPath path = path_of(stepped());
    ASSERT_TRUE(path.apply(Set{{}, delay_of(5ms)}, start + 1500ms));
    const auto& changes = path.changes().entries();
    ASSERT_EQ(changes.size(), 2U);
    EXPECT_EQ(changes[0].by, ChangeCause::timeline);
    EXPECT_EQ(changes[1].by, ChangeCause::hand);
}

TEST(EmulatedPath, NotesAProfileThatWasReadAgain)
{
    EmulatedPath path = path_of(stepped());
    Profile other;
    other.path.up.delay = Variation{ConstantLaw{70ms}, {}};
    ASSERT_TRUE(path.apply(Apply{other}, start + 500ms, ChangeCause::reload));
    ASSERT_EQ(path.changes().entries().size(), 1U);
    EXPECT_EQ(path.changes().entries().front().by, ChangeCause::reload);
    EXPECT_EQ(delay_in(path.changes().entries().front().patch(Direction::up)), 70ms);
}

TEST(ChangeLog, CountsWhatFindsNoRoom)
{
    ChangeLog log;
    for (std::size_t i = 0; i < ChangeLog::entries_max + 7; ++i) log.add({}, false);
    EXPECT_EQ(log.entries().size(), ChangeLog::entries_max);
    EXPECT_EQ(log.omitted(), 7U);
}

} // namespace
} // namespace hapnet::emulator::emulated_path_test

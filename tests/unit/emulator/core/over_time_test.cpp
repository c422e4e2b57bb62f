// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/over_time.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator::over_time_test {
namespace {

using namespace std::chrono_literals;

constexpr base::TimePoint start{1h};

TEST(OverTime, OfNoTimeHasNoStretch) { EXPECT_TRUE(OverTime{start}.report().empty()); }

TEST(OverTime, GivesEachTimeItsStretch)
{
    OverTime run{start};
    ++run.at(start).received;
    ++run.at(start + 10ms - 1ns).received;
    ++run.at(start + 10ms).received;
    ++run.at(start + 35ms).received;
    ++run.at(start + 12ms).dropped; // back, as departures and arrivals are stamped apart
    const auto report = run.report();
    ASSERT_EQ(report.size(), 4U);
    EXPECT_EQ(report[0].stretch.received, 2U);
    EXPECT_EQ(report[1].stretch.received, 1U);
    EXPECT_EQ(report[1].stretch.dropped, 1U);
    EXPECT_EQ(report[2].stretch.received, 0U);
    EXPECT_EQ(report[3].stretch.received, 1U);
    EXPECT_EQ(report[3].from, 30ms);
    EXPECT_EQ(report[3].length, 10ms);
}

TEST(OverTime, PutsWhatWasBeforeTheStartInTheFirst)
{
    OverTime run{start};
    ++run.at(start - 1h).received;
    ++run.at(start + 15ms).received;
    ++run.at(start - 1ns).received;
    EXPECT_EQ(run.stretches().front().received, 2U);
}

TEST(OverTime, MakesOneOfTwoStretchesWhenTheyAreUsedUpAndLosesNothing)
{
    OverTime run{start};
    constexpr int count = 10'000; // 100 s
    for (int i = 0; i < count; ++i) {
        Stretch& stretch = run.at(start + i * 10ms);
        ++stretch.received;
        stretch.left.on_sent(i * 1us, 1us);
        stretch.queue_max = std::max(stretch.queue_max, std::optional{i * 1us + 0ns});
    }
    EXPECT_EQ(run.length(), 640ms); // the least power of two times 10 ms with 256 in 100 s
    const auto report = run.report();
    ASSERT_EQ(report.size(), 157U);
    std::uint64_t received = 0;
    for (std::size_t i = 0; i < report.size(); ++i) {
        const Stretch& one = report[i].stretch;
        const auto first = static_cast<std::uint64_t>(i) * 64;
        const auto last = std::min<std::uint64_t>(first + 64, count) - 1;
        EXPECT_EQ(report[i].from, i * 640ms);
        EXPECT_EQ(one.received, last - first + 1);
        EXPECT_EQ(one.left.delay()->min, first * 1us);
        EXPECT_EQ(one.left.delay()->max, last * 1us);
        EXPECT_EQ(one.queue_max, last * 1us);
        received += one.received;
    }
    EXPECT_EQ(received, static_cast<std::uint64_t>(count));
}

TEST(OverTime, HasTheSameStretchesHoweverItWasLookedAt)
{
    OverTime by_steps{start};
    for (int i = 0; i <= 700; ++i) ++by_steps.at(start + i * 7ms).received;
    OverTime backwards{start};
    for (int i = 700; i >= 0; --i) ++backwards.at(start + i * 7ms).received;
    ASSERT_EQ(by_steps.length(), backwards.length());
    ASSERT_EQ(by_steps.stretches().size(), backwards.stretches().size());
    for (std::size_t i = 0; i < by_steps.stretches().size(); ++i)
        EXPECT_EQ(by_steps.stretches()[i].received, backwards.stretches()[i].received) << i;
}

TEST(OverTime, TakesATimeThatIsFarAway)
{
    OverTime run{start};
    ++run.at(start).received;
    ++run.at(start + 24h * 365 * 100).received;
    EXPECT_LE(run.stretches().size(), OverTime::stretches_max);
    EXPECT_EQ(run.stretches().front().received, 1U);
    EXPECT_EQ(run.stretches().back().received, 1U);
}

} // namespace
} // namespace hapnet::emulator::over_time_test

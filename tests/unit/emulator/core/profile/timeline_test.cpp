// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"
#include "emulator/core/profile/timeline.hpp"

#include <chrono>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;

Timeline timeline(std::string_view text)
{
    const auto profile = parse_profile(text, "test.toml", {});
    EXPECT_TRUE(profile) << (profile ? "" : profile.error().message);
    return Timeline{profile.value_or(Profile{})};
}

base::Duration delay(const Conditions& conditions)
{
    return std::get<ConstantLaw>(conditions.delay.law).value;
}

TEST(Timeline, AStepHoldsFromItsTimeOn)
{
    const Timeline line = timeline("both.delay = \"10ms\"\n"
                                   "[[at]]\ntime = \"2s\"\ndown.delay = \"30ms\"\n"
                                   "[[at]]\ntime = \"1s\"\nup.delay = \"20ms\"\n");
    EXPECT_EQ(delay(line.at(1s - 1ns).up), 10ms);
    EXPECT_EQ(delay(line.at(1s).up), 20ms);
    EXPECT_EQ(delay(line.at(2s - 1ns).down), 10ms);
    EXPECT_EQ(delay(line.at(2s).down), 30ms);
    EXPECT_EQ(delay(line.at(2s).up), 20ms);
    EXPECT_EQ(line.next_change(0s), 1s);
    EXPECT_EQ(line.next_change(1s), 2s);
    EXPECT_EQ(line.next_change(2s), std::nullopt);
}

TEST(Timeline, ARampGoesInAStraightLineAndStepsEveryMillisecond)
{
    const Timeline line = timeline("both.delay = \"10ms\"\n"
                                   "[[at]]\ntime = \"1s\"\nramp = \"2s\"\n"
                                   "up.delay = \"30ms\"\nup.loss = \"50%\"\n");
    EXPECT_EQ(delay(line.at(1s).up), 10ms);
    EXPECT_EQ(delay(line.at(1500ms).up), 15ms);
    EXPECT_EQ(line.at(2s).up.loss, (std::vector<LossLaw>{RandomLoss{25_percent}}));
    EXPECT_EQ(delay(line.at(3s).up), 30ms);
    EXPECT_EQ(line.next_change(0s), 1s);
    EXPECT_EQ(line.next_change(1s), 1001ms);
    EXPECT_EQ(line.next_change(1500ms + 300us), 1501ms);
    EXPECT_EQ(line.next_change(2999ms), 3s);
    EXPECT_EQ(line.next_change(3s), std::nullopt);
}

TEST(Timeline, ALaterChangeTakesOverFromWhereverTheRampIs)
{
    const Timeline line = timeline("both.delay = \"0ms\"\nboth.jitter = \"0ms\"\n"
                                   "[[at]]\ntime = \"1s\"\nramp = \"4s\"\n"
                                   "both.delay = \"40ms\"\nboth.jitter = \"8ms\"\n"
                                   "[[at]]\ntime = \"3s\"\nramp = \"1s\"\nup.delay = \"0ms\"\n");
    EXPECT_EQ(delay(line.at(3s).up), 20ms);
    EXPECT_EQ(delay(line.at(3500ms).up), 10ms);
    EXPECT_EQ(delay(line.at(4500ms).up), 0ms);
    EXPECT_EQ(delay(line.at(4s).down), 30ms);
    EXPECT_EQ(line.at(4s).up.jitter.law, (DelayLaw{UniformLaw{0ms, 6ms}}));
    EXPECT_EQ(delay(line.at(6s).down), 40ms);
}

TEST(Timeline, SharesOneListOfLossesAmongAllItsChanges)
{
    Profile profile;
    profile.path.up.loss = {ListedLoss{std::vector<std::uint64_t>(1'000'000)}};
    for (int i = 1; i <= 1000; ++i) profile.timeline.push_back({1s * i, {}, {}, {}});
    const Timeline line{profile};
    const auto& first = std::get<ListedLoss>(profile.path.up.loss.front()).numbers;
    const Path last = line.at(1000s);
    EXPECT_EQ(&std::get<ListedLoss>(last.up.loss.front()).numbers.get(), &first.get());
}

TEST(Timeline, ChangesAtOneTimeHoldInTheirOrder)
{
    const Timeline line = timeline("[[at]]\ntime = \"1s\"\nboth.delay = \"1ms\"\n"
                                   "[[at]]\ntime = \"1s\"\nboth.delay = \"2ms\"\n");
    EXPECT_EQ(delay(line.at(1s).up), 2ms);
    EXPECT_EQ(line.next_change(1s), std::nullopt);
}

} // namespace
} // namespace hapnet::emulator

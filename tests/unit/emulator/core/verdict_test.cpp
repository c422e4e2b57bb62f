// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/verdict.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;
using Reasons = std::vector<std::string>;

TEST(Verdict, OnNothingIsValid) { EXPECT_EQ(invalid_because(Statistics{}, 0, 0ns), Reasons{}); }

TEST(Verdict, NamesTheLatenessThatIsAboveTheBudget)
{
    Statistics statistics;
    for (int i = 0; i < 100; ++i) statistics.lateness.add(0us);
    EXPECT_EQ(invalid_because(statistics, 0, 1ms), Reasons{});
    for (int i = 0; i < 100; ++i) statistics.lateness.add(1s);
    const auto reasons = invalid_because(statistics, 0, 1ms);
    ASSERT_EQ(reasons.size(), 1U);
    EXPECT_TRUE(reasons[0].starts_with("p99 ")) << reasons[0];
    EXPECT_TRUE(reasons[0].ends_with(" us is above the budget of 1000 us")) << reasons[0];
}

TEST(Verdict, NamesEachLossOfTheEmulatorsOwnAndNoneThatWasAskedForOrHasItsCauseElsewhere)
{
    for (const DropCause cause : drop_causes) {
        Statistics statistics;
        statistics.dropped[cause] = 7;
        const bool is_own = std::ranges::find(own_losses, cause) != own_losses.end();
        const Reasons expected{fmt::format("the emulator lost 7 as {}", to_text(cause))};
        EXPECT_EQ(invalid_because(statistics, 0, 1ms), is_own ? expected : Reasons{});
    }
    EXPECT_EQ(invalid_because(Statistics{}, 3, 1ms), Reasons{"the emulator lost 3 as overflowed"});
}

} // namespace
} // namespace hapnet::emulator

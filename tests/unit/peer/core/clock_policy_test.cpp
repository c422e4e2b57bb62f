// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/clock_policy.hpp"

#include "tests/unit/peer/core/meeting.hpp"

#include <gtest/gtest.h>
#include <string_view>

namespace hapnet::peer::clock_policy_test {
namespace {

using namespace std::chrono_literals;

TEST(ClockPolicy, IsReadAndWritten)
{
    EXPECT_EQ(parse_clock_policy("echo"), ClockPolicy{});
    EXPECT_EQ(parse_clock_policy("synchronised")->synchronised_within, 0s);
    EXPECT_EQ(parse_clock_policy("synchronised:250us")->synchronised_within, 250us);
    EXPECT_EQ(text_of(ClockPolicy{}), "echo");
    EXPECT_EQ(text_of(ClockPolicy{2ms}), "synchronised:2ms");
    EXPECT_EQ(parse_clock_policy(text_of(ClockPolicy{2ms})), ClockPolicy{2ms});
}

TEST(ClockPolicy, IsRefusedWithWhatIsPossible)
{
    for (const std::string_view text :
         {"", "ntp", "synchronised:", "synchronised:2", "synchronised:-1ms", "synchronised:2s"}) {
        const auto policy = parse_clock_policy(text);
        ASSERT_FALSE(policy) << text;
        EXPECT_NE(policy.error().message.find("synchronised:2ms"), std::string::npos);
    }
}

TEST(ClockPolicy, NamesOneClockForAllThatAreSynchronisedAndOneForEachBootOtherwise)
{
    const ClockPolicy synchronised{1ms};
    EXPECT_EQ(clock_hash(synchronised, "one"), clock_hash(ClockPolicy{5ms}, "two"));
    EXPECT_NE(clock_hash(ClockPolicy{}, "one"), clock_hash(ClockPolicy{}, "two"));
    EXPECT_NE(clock_hash(ClockPolicy{}, "one"), clock_hash(synchronised, "one"));
    EXPECT_EQ(clock_hash(ClockPolicy{}, ""), 0U);
}

TEST(ClockPolicy, OfTwoSynchronisedPeersKeepsTheirStartsTogetherOnAnAsymmetricPath)
{
    for (const bool is_synchronised : {false, true}) {
        Meeting meeting{{.delay_min = 10ms, .delay_max = 10ms, .longer_back = 300ms}};
        if (is_synchronised) meeting.boot = clock_hash(ClockPolicy{1ms}, "");
        for (const std::size_t side : {0U, 1U}) meeting.restart(side);
        meeting.run_for(4s);
        ASSERT_TRUE(meeting.agree());
        EXPECT_EQ(meeting.start_error(), is_synchronised ? 0ms : 150ms);
    }
}

} // namespace
} // namespace hapnet::peer::clock_policy_test

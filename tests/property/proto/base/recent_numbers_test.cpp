// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/recent_numbers.hpp"

#include "proto/base/random.hpp"

#include <array>
#include <gtest/gtest.h>
#include <limits>
#include <set>

namespace hapnet::base {
namespace {

TEST(RecentNumbers, AgreeWithASetThatForgetsNothing)
{
    constexpr std::uint64_t looks_back = 128;
    std::array<std::size_t, 3> found{};
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const RandomStream draw = Seed{seed}.stream("numbers");
        RecentNumbers<looks_back> recent;
        std::set<std::uint64_t> seen;
        // Starts at 0, below which there is no number, or goes up to the largest number.
        const bool is_last = seed % 2 == 0;
        std::uint64_t at = is_last ? std::numeric_limits<std::uint64_t>::max() - 50'000 : 0;
        for (std::uint64_t i = 0; i < 500; ++i) {
            const auto kind = draw.below(10, i, 1);
            if (kind == 0) at += draw.below(3 * looks_back, i, 2); // a leap
            if (kind < 5) ++at;
            const std::uint64_t back = draw.below(kind < 8 ? 8 : 2 * looks_back, i, 3);
            const std::uint64_t number = at - std::min(back, at);
            const bool is_old =
                !seen.empty() && number < *seen.rbegin() && *seen.rbegin() - number >= looks_back;
            const Seen expected = is_old                  ? Seen::too_old_to_tell
                                  : seen.contains(number) ? Seen::yes
                                                          : Seen::no;
            ++found[static_cast<std::size_t>(expected)];
            ASSERT_EQ(recent.find(number), expected) << seed << " " << i;
            ASSERT_EQ(recent.add(number), expected) << seed << " " << i;
            if (!is_old) seen.insert(number);
            ASSERT_EQ(recent.highest(), *seen.rbegin());
        }
    }
    EXPECT_GT(std::ranges::min(found), 1000U); // all three answers occurred
}

} // namespace
} // namespace hapnet::base

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/rate_limit.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

TEST(RateLimit, LetsTheFirstPassAtOnceAndThenOneInTenSeconds)
{
    RateLimit limit;
    int passed = 0;
    for (int i = 0; i < 20'001; ++i) {
        if (limit.permits(base::TimePoint{1s} + i * 1ms)) ++passed;
    }
    EXPECT_EQ(passed, 3);
}

} // namespace
} // namespace hapnet::emulator

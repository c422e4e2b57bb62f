// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/nearest.hpp"

#include "proto/base/random.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::base {

TEST(Nearest, IsWhatTheLibraryRoundsTo)
{
    for (const double x : {0.0, 0.49999999999999994, 0.5, 0.5000000000000001, 1.5, 2.5, 32767.5,
                           4503599627370495.5, 4503599627370496.0, 9007199254740993.0, 9e18}) {
        EXPECT_EQ(nearest(x), std::llround(x)) << x;
        EXPECT_EQ(nearest(-x), std::llround(-x)) << x;
    }
    const auto draw = Seed{1}.stream("nearest");
    for (std::uint64_t i = 0; i < 10'000; ++i) {
        const double x = (2.0 * draw.uniform(2 * i) - 1.0) *
                         std::pow(10.0, 19.0 * draw.uniform(2 * i + 1) - 1.0);
        ASSERT_EQ(nearest(x), std::llround(x)) << x;
    }
}

TEST(Nearest, IsTheLeastNumberWhereThereIsNone)
{
    const auto none = std::numeric_limits<std::int64_t>::min();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double x : {0x1p63, -0x1p63, 1e300, infinity, -infinity, std::nan("")}) {
        EXPECT_EQ(nearest(x), none) << x;
    }
    EXPECT_EQ(nearest(0x1.fffffffffffffp62), 0x7ffffffffffffc00);
}

} // namespace hapnet::base

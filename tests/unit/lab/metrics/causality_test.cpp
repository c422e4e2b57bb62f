// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/causality.hpp"
#include "tests/unit/lab/metrics/columns_of_a_hand.hpp"

#include <gtest/gtest.h>

namespace hapnet::lab::metrics {
namespace {

TEST(Response, IsTheTimeFromATouchUntilTheOthersBodyMoves)
{
    Columns left = resting(1000);
    Columns right = resting(1000);
    for (std::size_t i = 200; i < 230; ++i) left.touching[i] = 1;
    for (std::size_t i = 240; i < 300; ++i) left.touching[i] = 1; // bounces: not a tap of its own
    for (std::size_t i = 263; i < 1000; ++i) right.body_x[i] = 0.005;
    EXPECT_NEAR(*response_of(left, right, tick_s), 0.063, 1e-12);
}

TEST(Response, LooksOnlyAtWhatBeginsAtRest)
{
    Columns left = resting(1000);
    Columns right = resting(1000);
    for (std::size_t i = 200; i < 300; ++i) left.touching[i] = 1;
    EXPECT_FALSE(response_of(left, right, tick_s)); // nothing moves
    for (std::size_t i = 150; i < 1000; ++i) right.body_x[i] = 3e-5 * static_cast<double>(i);
    EXPECT_FALSE(response_of(left, right, tick_s)); // it moves already, at 30 mm/s
    EXPECT_FALSE(response_of(resting(5), resting(5), tick_s));
    EXPECT_FALSE(response_of({}, {}, tick_s));
}

} // namespace
} // namespace hapnet::lab::metrics

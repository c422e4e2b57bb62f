// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Single ticks, computed by hand.
#include "peer/core/sync/couple.hpp"
#include "tests/unit/peer/core/sync/copy.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::peer::couple_test {
namespace {

Copy<Couple> with_one_other()
{
    Couple algorithm;
    algorithm.prepare(1);
    return Copy<Couple>{algorithm};
}

TEST(Couple, DrawsTheBodyWithTheStiffestSpringOverNoDelay)
{
    auto copy = with_one_other();
    copy.hear({.sent_ms = 0.0, .body_mm = 10.0}, 0.0);
    EXPECT_NEAR(copy.tick(0.0).remote_force.x(), 300.0 * 0.010, 1e-9);
    EXPECT_NEAR(copy.algorithm.springs()[0].tank_j, 0.020 - 0.015, 1e-4); // and what drag gave
}

TEST(Couple, IsAsStiffAsTheDragOverTheAge)
{
    auto copy = with_one_other();
    copy.hear({.sent_ms = 0.0, .body_mm = 10.0}, 100.0);
    EXPECT_NEAR(copy.tick(100.0).remote_force.x(), 10.0 / 0.101 * 0.010, 1e-3);
}

TEST(Couple, StretchesASpringOnlyAsFarAsItsTankReaches)
{
    auto copy = with_one_other();
    copy.hear({.sent_ms = 0.0, .body_mm = 20.0}, 0.0); // 60 mJ at 300 N/m
    EXPECT_NEAR(copy.tick(0.0).remote_force.x(), std::sqrt(2.0 * 300.0 * 0.020), 1e-9);
    EXPECT_LT(copy.algorithm.springs()[0].tank_j, 1e-4);
}

TEST(Couple, LetsGoOfACopyThatIsNotHeard)
{
    auto copy = with_one_other();
    copy.hear({.sent_ms = 0.0, .body_mm = 10.0}, 0.0);
    EXPECT_EQ(copy.tick(0.0, away, 0.0).remote_force, base::Force{});
}

} // namespace
} // namespace hapnet::peer::couple_test

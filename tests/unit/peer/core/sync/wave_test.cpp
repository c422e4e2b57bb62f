// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Single ticks, computed by hand.
#include "peer/core/sync/wave.hpp"
#include "tests/unit/peer/core/sync/copy.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::peer::wave_test {
namespace {

Copy<Wave> with_one_other()
{
    Wave algorithm;
    algorithm.prepare(1);
    return Copy<Wave>{algorithm};
}

TEST(Wave, ArrivesOnceAndIsADamperOtherwise)
{
    auto copy = with_one_other();
    copy.hear({.sent_ms = 0.0, .speed_m_per_s = 0.1}, 50.0);
    // The sender had no wave of ours, so it has sqrt(2 b) v, and at rest F = sqrt(2 b) times that.
    EXPECT_NEAR(copy.tick(50.0).remote_force.x(), 2.0 * 10.0 * 0.1, 1e-9);
    const double speed = copy.speed();
    ASSERT_GT(speed, 0.0);
    EXPECT_NEAR(copy.tick(51.0).remote_force.x(), -10.0 * speed, 1e-9);
}

TEST(Wave, FromASenderThatHadOursIsLessByIt)
{
    auto copy = with_one_other();
    copy.hear({.sent_ms = 0.0, .speed_m_per_s = 0.1}, 50.0);
    static_cast<void>(copy.tick(50.0));
    const double ours = std::sqrt(20.0) * copy.speed() - std::sqrt(20.0) * 0.1;
    wire::State state;
    state.sequence = 2;
    state.echo = wire::Echo{.of = at_ms(50.0), .age = 300us}; // it acted in that tick
    copy.algorithm.hear({.state = state, .arrived = at_ms(51.0)});
    const double speed = copy.speed();
    EXPECT_NEAR(copy.tick(51.0).remote_force.x(), std::sqrt(20.0) * -ours - 10.0 * speed, 1e-9);
    state.sequence = 3;
    state.echo->age = 1200us; // it had acted before
    copy.algorithm.hear({.state = state, .arrived = at_ms(52.0)});
    const double speed_then = copy.speed();
    EXPECT_NEAR(copy.tick(52.0).remote_force.x(), -10.0 * speed_then, 1e-9);
}

TEST(Wave, IsNotAnsweredWhileNoHandIsOnTheBody)
{
    auto copy = with_one_other();
    const auto push_after = [&copy](double now_ms, bool touching) {
        const auto number = static_cast<std::uint32_t>(now_ms);
        copy.hear(
            {.sequence = number, .sent_ms = now_ms, .speed_m_per_s = 0.1, .touching = touching},
            now_ms);
        return copy.tick(now_ms).remote_force.x();
    };
    for (double now_ms = 1.0; now_ms < 201.0; ++now_ms) ASSERT_GT(push_after(now_ms, false), 0.0);
    for (double now_ms = 201.0; now_ms < 300.0; ++now_ms)
        ASSERT_EQ(push_after(now_ms, false), 0.0) << now_ms;
    static_cast<void>(push_after(300.0, true)); // touched: from the next tick on
    const double speed = copy.speed();
    EXPECT_NEAR(push_after(301.0, true), 2.0 * 10.0 * 0.1 - 10.0 * speed, 1e-9);
}

} // namespace
} // namespace hapnet::peer::wave_test

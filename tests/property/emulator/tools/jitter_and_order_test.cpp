// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/describe.hpp"
#include "emulator/tools/predict.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;

double in_ms(base::Duration duration)
{
    return std::chrono::duration<double, std::milli>{duration}.count();
}

struct Expected {
    const char* name;
    Variation jitter;
    Order order;
    double added_ms;  // to the mean, by the order
    double sd_ms;     //
    double reordered; // share, RFC 4737
    double clumped;   // share of gaps below 50 us
};

Variation correlated(base::Duration half_width, base::Duration time)
{
    return {UniformLaw{{}, half_width}, time};
}

/// The effect of independent and correlated jitter at 1000 packets/s under each policy. Computed
/// apart from this code, in Python, over 400 000 packets. The correlated rows have few independent
/// draws (400 000 ms / 2 x 100 ms = 2000), hence the tolerance of each.
TEST(Predict, TheTableOfJitterAndOrderAtAThousandPacketsASecond)
{
    const std::vector<std::pair<Expected, double>> rows{
        {{"1 ms free", uniform(1ms), Order::free, 0.0, 0.58, 0.12, 0.03}, 0.02},
        {{"1 ms keep", uniform(1ms), Order::keep, 0.04, 0.54, 0.0, 0.14}, 0.02},
        {{"5 ms free", uniform(5ms), Order::free, 0.0, 2.88, 0.59, 0.04}, 0.02},
        {{"5 ms keep", uniform(5ms), Order::keep, 1.88, 1.72, 0.0, 0.59}, 0.02},
        {{"5 ms sorted", uniform(5ms), Order::sorted, 0.0, 1.26, 0.0, 0.04}, 0.02},
        {{"5 ms, 20 ms", correlated(5ms, 20ms), Order::keep, 0.09, 2.85, 0.0, 0.18}, 0.05},
        {{"5 ms, 100 ms", correlated(5ms, 100ms), Order::keep, 0.01, 2.92, 0.0, 0.02}, 0.15},
        {{"15 ms free", uniform(15ms), Order::free, 0.0, 8.67, 0.77, 0.05}, 0.05},
        {{"15 ms keep", uniform(15ms), Order::keep, 9.0, 3.24, 0.0, 0.77}, 0.06},
        {{"15 ms, 100 ms", correlated(15ms, 100ms), Order::keep, 0.4, 8.58, 0.0, 0.27}, 0.35},
        {{"exponential", {ExponentialLaw{5ms}, {}}, Order::keep, 6.6, 6.1, 0.0, 0.80}, 0.3},
    };
    for (const auto& [row, tolerance_ms] : rows) {
        SCOPED_TRACE(row.name);
        Profile profile;
        profile.path.up.delay = constant(100ms);
        profile.path.up.jitter = row.jitter;
        profile.path.up.order = row.order;
        const Stream stream{.packets = 200'000};
        const auto up = predict(profile, stream, base::Seed{1}).up;
        EXPECT_NEAR(in_ms(up.added_by_queues), row.added_ms, tolerance_ms);
        EXPECT_NEAR(in_ms(*up.measured.delay->sd), row.sd_ms, tolerance_ms);
        const auto packets = static_cast<double>(stream.packets);
        EXPECT_NEAR(static_cast<double>(up.measured.reordered.count) / packets, row.reordered,
                    0.01);
        EXPECT_NEAR(*up.measured.clumped_share, row.clumped, 0.01);
    }
}

TEST(Predict, LossesAreCountedInShareAndRuns)
{
    Profile profile;
    profile.path.up.loss = {Burst{40, 100, 0}};
    const auto [up, down] = predict(profile, {.packets = 10'000}, base::Seed{1});
    EXPECT_EQ(up.loss_runs.sum, 4'000U);
    EXPECT_EQ(up.loss_runs.count, 100U);
    EXPECT_EQ(up.loss_runs.max, 40U);
    EXPECT_DOUBLE_EQ(up.loss_share(), 0.4);
    EXPECT_EQ(down.loss_runs.sum, 0U);
    EXPECT_EQ(down.statistics.delivered, 10'000U);
}

TEST(Predict, TheTimelineIsPlayed)
{
    Profile profile;
    Change change;
    change.time = 5s;
    change.up.delay = constant(20ms);
    profile.timeline = {change};
    const auto up = predict(profile, {.packets = 10'000}, base::Seed{1}).up;
    EXPECT_EQ(up.measured.delay->mean, 10ms);
}

TEST(Predict, AWideJitterThatKeepsTheOrderIsWarnedOf)
{
    Profile profile;
    profile.path.up.delay = constant(160ms);
    profile.path.up.jitter = uniform(15ms);
    const Stream stream{.packets = 100'000};
    const auto up = predict(profile, stream, base::Seed{1}).up;
    const auto list = warnings(profile.path.up, stream, up);
    ASSERT_EQ(list.size(), 1U);
    EXPECT_EQ(list[0].substr(0, 85), "keeping the order makes the mean 8.95 ms longer and the sd "
                                     "3.27 ms instead of 8.65 ms");
    EXPECT_EQ(
        describe(profile.path.up, stream),
        (std::vector<std::string>{"delay: 160 ms",
                                  "jitter uniform: mean 0 ms, sd 8.66 ms, each datagram on its own",
                                  "order keep: none leaves before one that came earlier"}));
}

} // namespace
} // namespace hapnet::emulator::tools

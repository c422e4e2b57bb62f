// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// No stage, law or direction disturbs the draws of another.
#include "emulator/core/conditions.hpp"
#include "emulator/core/pipeline.hpp"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <vector>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;
using namespace base::literals; // NOLINT(google-build-using-namespace): literals only

struct Draw {
    base::Seed seed{42};
    Direction direction = Direction::up;
    std::uint64_t count = 2000;
};

std::vector<Fate> fates(const Conditions& conditions, const Draw& draw)
{
    Pipeline pipeline{conditions, draw.seed, draw.direction};
    std::vector<Fate> drawn;
    for (std::uint64_t number = 0; number < draw.count; ++number) {
        drawn.push_back(pipeline.on_packet({number, 96, 1ms * number}));
    }
    return drawn;
}

bool is_lost(const Fate& fate) { return fate.drop.has_value(); }

/// Conditions with every stage.
Conditions crowded()
{
    return {.mtu = {1400},
            .rate = {1'000'000, 28, 1000},
            .loss = {RandomLoss{30_percent}, Burst{4, 17, {}}},
            .corrupt = {10_percent, 2},
            .duplicate = {10_percent, 3ms},
            .delay = constant(50ms),
            .jitter = uniform(20ms),
            .order = Order::free,
            .reorder = {10_percent, {2, {}}}};
}

} // namespace

TEST(Fate, OfTheNthDatagramIsTheSameForTheSameSeed)
{
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        EXPECT_EQ(fates(crowded(), {base::Seed{seed}}), fates(crowded(), {base::Seed{seed}}));
    }
}

TEST(Fate, DiffersBetweenSeedsAndDirections)
{
    EXPECT_NE(fates(crowded(), {base::Seed{1}}), fates(crowded(), {base::Seed{2}}));
    EXPECT_NE(fates(crowded(), {base::Seed{1}, Direction::up}),
              fates(crowded(), {base::Seed{1}, Direction::down}));
}

TEST(Fate, OfLossDoesNotDependOnAnyOtherStage)
{
    const Conditions alone{.loss = {RandomLoss{30_percent}, Burst{4, 17, {}}}};
    const auto expected = fates(alone, {});
    const auto with_all = fates(crowded(), {});
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(is_lost(expected[i]), is_lost(with_all[i]));
    }
}

TEST(Fate, OfEachOtherStageDoesNotDependOnTheRest)
{
    const auto with_all = fates(crowded(), {});
    const auto corrupted = fates({.corrupt = {10_percent, 2}}, {});
    const auto copied = fates({.duplicate = {10_percent, 3ms}}, {});
    const auto delayed = fates({.delay = constant(50ms), .jitter = uniform(20ms)}, {});
    const auto displaced = fates({.reorder = {10_percent, {2, {}}}}, {});
    int compared = 0;
    for (std::size_t i = 0; i < with_all.size(); ++i) {
        if (is_lost(with_all[i])) continue;
        ++compared;
        EXPECT_EQ(with_all[i].flips, corrupted[i].flips);
        EXPECT_EQ(with_all[i].copy_after, copied[i].copy_after);
        EXPECT_EQ(with_all[i].delay, delayed[i].delay);
        EXPECT_EQ(with_all[i].displacement, displaced[i].displacement);
    }
    EXPECT_GT(compared, 500);
}

TEST(Fate, WithMoreLossLosesWhatWasLostBeforeAndMore)
{
    const auto few = fates({.loss = {RandomLoss{10_percent}}}, {});
    const auto many = fates({.loss = {RandomLoss{60_percent}}}, {});
    for (std::size_t i = 0; i < few.size(); ++i) EXPECT_TRUE(is_lost(many[i]) || !is_lost(few[i]));
}

TEST(Fate, OfTheTwoDirectionsIsUncorrelated)
{
    // The sample correlation of n independent pairs has standard error 1 / sqrt(n).
    constexpr std::uint64_t count = 100'000;
    const Conditions conditions{.loss = {RandomLoss{30_percent}}};
    for (const std::uint64_t seed : {0U, 1U, 42U}) {
        const auto up = fates(conditions, {base::Seed{seed}, Direction::up, count});
        const auto down = fates(conditions, {base::Seed{seed}, Direction::down, count});
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i) {
            sum += (is_lost(up[i]) ? 0.7 : -0.3) * (is_lost(down[i]) ? 0.7 : -0.3);
        }
        EXPECT_NEAR(sum / (count * 0.21), 0.0, 4 / std::sqrt(count)) << "seed " << seed;
    }
}

} // namespace hapnet::emulator

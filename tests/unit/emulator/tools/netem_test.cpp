// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/netem.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator::tools {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;

NetemProfile read(std::string_view sentence)
{
    const auto profile = parse_netem(sentence);
    EXPECT_TRUE(profile) << (profile ? "" : profile.error().message);
    return profile.value_or(NetemProfile{});
}

std::string refusal(std::string_view sentence)
{
    const auto profile = parse_netem(sentence);
    EXPECT_FALSE(profile) << sentence;
    return profile ? "" : profile.error().message;
}

bool warns(const NetemProfile& profile, std::string_view part)
{
    return std::any_of(profile.warnings.begin(), profile.warnings.end(), [&](const auto& warning) {
        return warning.find(part) != std::string::npos;
    });
}

TEST(Netem, ASentenceBecomesConditions)
{
    const auto netem = read("tc qdisc add dev eth0 root netem delay 80ms 5ms 25% distribution "
                            "normal loss gemodel 1% 30% duplicate 2% corrupt 3% seed 7");
    const Conditions& is = netem.conditions;
    EXPECT_EQ(is.delay, constant(80ms));
    EXPECT_EQ(is.jitter.law, (DelayLaw{NormalLaw{0ms, 5ms}}));
    EXPECT_EQ(is.jitter.correlation_time, 721348ns); // -1 ms / ln(0.25)
    EXPECT_EQ(is.order, Order::free);
    EXPECT_EQ(is.loss, (std::vector<LossLaw>{
                           GilbertElliott{1_percent, 30_percent, 0_percent, 100_percent}}));
    EXPECT_EQ(is.duplicate.share, 2_percent);
    EXPECT_EQ(is.corrupt, (Corruption{3_percent, 1}));
    EXPECT_EQ(netem.seed, base::Seed{7});
    EXPECT_TRUE(warns(netem, "has no effect"));
}

// The numbers in brackets were measured with Linux 6.1, over 100 000 packets. The first number is
// exact: P(X <= 0.1) = (1/3) of the integral of P(X <= x) from 0 to 0.4, which is 0.0125 + 0.04.
TEST(Netem, TheShareOfCorrelatedLossIsWhatTheKernelMakesOfIt)
{
    EXPECT_NEAR(netem_correlated_share(0.10, 0.25), 0.0175, 1e-6);  // (1.67 %)
    EXPECT_NEAR(netem_correlated_share(0.10, 0.50), 0.0011, 1e-4);  // (0.11 %)
    EXPECT_NEAR(netem_correlated_share(0.93, 0.25), 0.9940, 1e-4);  // (99.3 %)
    EXPECT_NEAR(netem_correlated_share(0.003, 0.25), 0.0000, 1e-5); // (0)
    EXPECT_NEAR(netem_correlated_share(0.5, 0.9), 0.5, 1e-6);
    EXPECT_TRUE(warns(read("loss 10% 25%"), "netem would have lost 1.75 %, not 10%"));
}

TEST(Netem, CorrelatedLossIsDoneWithTheShareThatWasAskedFor)
{
    const auto netem = read("loss random 20% 50%");
    ASSERT_EQ(netem.conditions.loss.size(), 1U);
    const auto& law = std::get<Gilbert>(netem.conditions.loss[0]);
    EXPECT_EQ(law.share, 20_percent);
    EXPECT_DOUBLE_EQ(law.mean_burst, 2.5);
}

TEST(Netem, TheFourStatesAreReadByWhatTheyAmountTo)
{
    // Loss 5 %, bursts of 20, density 0.8, isolated 0.5 %, good runs of 2.
    const auto netem = read("loss state 0.302% 6.25% 12.5% 50% 0.503%");
    const auto& law = std::get<FourState>(netem.conditions.loss.at(0));
    EXPECT_NEAR(law.share.fraction(), 0.05, 1e-4);
    EXPECT_NEAR(law.burst, 20.0, 1e-9);
    EXPECT_NEAR(law.density.fraction(), 0.8, 1e-9);
    EXPECT_NEAR(law.isolated.fraction(), 0.005, 1e-5);
    EXPECT_NEAR(law.good_run, 2.0, 1e-9);
    EXPECT_EQ(read("loss state 1% 10%").conditions.loss,
              (std::vector<LossLaw>{GilbertElliott{1_percent, 10_percent, {}, 100_percent}}));
}

TEST(Netem, ReorderSendsSomeAtOnceAndTheOthersBehindTheirTurn)
{
    const auto netem = read("delay 10ms reorder 25% gap 5");
    EXPECT_EQ(netem.conditions.delay, constant(0ms));
    EXPECT_EQ(netem.conditions.reorder,
              (Reordering{*base::Probability::from_fraction(1.0 - 1.0 / 8.0), {0, 10ms}}));
    EXPECT_EQ(read("delay 10ms reorder 25%").conditions.reorder,
              (Reordering{75_percent, {0, 10ms}}));
}

TEST(Netem, ARateKeepsTheOrderAndCountsTheHeaders)
{
    const auto netem = read("delay 50ms 5ms rate 10mbit 20");
    EXPECT_EQ(netem.conditions.order, Order::keep);
    EXPECT_EQ(
        netem.conditions.rate,
        (Rate{.bits_per_second = 10'000'000, .overhead_bytes = 62, .queue_bytes_max = 1'514'000}));
    EXPECT_EQ(read("rate 1mbps").conditions.rate.bits_per_second, 8'000'000U);
}

TEST(Netem, APeculiarityOfTcIsWarnedOf)
{
    EXPECT_EQ(read("delay 100").conditions.delay, constant(100us));
    EXPECT_TRUE(warns(read("delay 100"), "100 without a unit is 100 us to tc"));
    EXPECT_TRUE(warns(read("delay 50ms 5ms distribution pareto"), "an sd of 4.1 ms, not 5 ms"));
    EXPECT_TRUE(warns(read("delay 50ms 5ms distribution uniform"), "tc refuses"));
    EXPECT_TRUE(warns(read("delay 2s"), "above 500 packets/s it would drop"));
    EXPECT_TRUE(warns(read("duplicate 10% 25%"), "has no effect"));
    EXPECT_TRUE(warns(read("delay 50ms 15ms"), "netem's jitter reorders"));
    EXPECT_TRUE(read("delay 50ms loss 1").warnings.empty());
}

TEST(Netem, WhatCannotBeDoneIsRefusedByItsWord)
{
    EXPECT_EQ(refusal("delay 10ms slot 20ms"),
              "word 3: netem's slot cannot be emulated: leave it out");
    EXPECT_EQ(refusal("delay"), "after word 1, 'delay': expected a time, such as 80ms");
    EXPECT_EQ(refusal("delay 80ms loss random"),
              "after word 4, 'random': expected a share, such as 1%");
    EXPECT_EQ(refusal("dely 80ms"), "word 1: unknown netem option 'dely': did you mean 'delay'?");
    EXPECT_EQ(refusal("delay 10m"), "word 2: '10m' is not a time: write 80ms, for instance");
    EXPECT_EQ(refusal("loss 101%"), "word 2: '101%' is more than 100%");
    EXPECT_EQ(refusal("reorder 5%"), "word 2: reorder needs a delay");
    EXPECT_EQ(refusal("delay 10ms 1ms distribution experimental").substr(0, 8), "word 5: ");
    EXPECT_EQ(refusal("rate 10mbit 0 53").substr(0, 8), "word 4: ");
    EXPECT_EQ(refusal(""), "the sentence is empty: write, for example, \"delay 80ms loss 1%\"");
}

} // namespace
} // namespace hapnet::emulator::tools

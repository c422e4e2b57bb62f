// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/predict.hpp"

#include "emulator/tools/describe.hpp"

#include <chrono>
#include <gtest/gtest.h>

namespace hapnet::emulator::tools::predict_test {
namespace {

using namespace std::chrono_literals;
using namespace base::literals;

const Stream short_stream{.packets = 2000};

/// A constant delay, and uniform jitter with a correlation time.
Profile jittery(base::Duration half_width, base::Duration correlation_time)
{
    Profile profile;
    profile.path.up.delay = Variation{ConstantLaw{50ms}, {}};
    profile.path.up.jitter = Variation{UniformLaw{0ms, half_width}, correlation_time};
    profile.path.up.order = Order::free;
    return profile;
}

Prediction settled(const Profile& profile, std::uint64_t packets_max)
{
    return predict_until_settled(profile, short_stream, base::Seed{1}, packets_max);
}

TEST(Predict, StopsWhereItBeganWhenTheDelayIsConstant)
{
    const auto prediction = settled(jittery(0ms, 0ms), 1'000'000);
    EXPECT_EQ(prediction.up.statistics.received, 2000U);
    EXPECT_TRUE(prediction.is_settled());
}

TEST(Predict, GoesOnUntilMeanAndDeviationHaveSettled)
{
    const auto prediction = settled(jittery(15ms, 0ms), 1'000'000);
    EXPECT_TRUE(prediction.is_settled());
    EXPECT_GT(prediction.up.statistics.received, 2000U);
    EXPECT_LE(prediction.up.precision->sd, settled_to);
    // +-15 ms uniform: 8.660 ms.
    EXPECT_NEAR(base::to_seconds(*prediction.up.measured.delay->sd) * 1e3, 8.660, 0.2);
}

TEST(Predict, PlaysTheSameDatagramsFurther)
{
    const auto profile = jittery(15ms, 0ms);
    const auto prediction = settled(profile, 1'000'000);
    const auto again =
        predict(profile, {.packets = prediction.up.statistics.received}, base::Seed{1});
    EXPECT_EQ(again.up.measured.delay->mean, prediction.up.measured.delay->mean);
    EXPECT_EQ(again.down.statistics.delivered, prediction.down.statistics.delivered);
}

TEST(Predict, CountsWhatIsDamagedAsLostWhereItIsSealed)
{
    Profile profile;
    profile.path.up.loss = {RandomLoss{10_percent}};
    profile.path.up.corrupt = {20_percent, 3};
    const auto plain = predict(profile, {.packets = 20'000}, base::Seed{1});
    const auto sealed = predict(profile, {.packets = 20'000, .is_sealed = true}, base::Seed{1});
    // The same draws: what arrives damaged is all that differs.
    EXPECT_EQ(sealed.up.statistics.corrupted, plain.up.statistics.corrupted);
    EXPECT_GT(plain.up.statistics.corrupted, 3000U);
    EXPECT_EQ(sealed.up.loss_runs.sum, plain.up.loss_runs.sum + plain.up.statistics.corrupted);
    EXPECT_GT(sealed.up.loss_runs.count, plain.up.loss_runs.count);
    EXPECT_EQ(sealed.down.loss_runs.sum, 0U);
}

TEST(Predict, GivesUpAndSaysWhy)
{
    const auto profile = jittery(15ms, 5s);
    const auto prediction = settled(profile, 16'000);
    EXPECT_EQ(prediction.up.statistics.received, 16'000U);
    EXPECT_FALSE(prediction.is_settled());
    const auto why = why_unsettled(profile.path.up, short_stream, prediction.up, false);
    EXPECT_NE(why.find("correlated over 5000 ms"), std::string::npos) << why;
    EXPECT_EQ(why_unsettled(profile.path.down, short_stream, prediction.down, false), "");
}

TEST(Predict, DoesNotSettleConditionsThatChange)
{
    auto profile = jittery(15ms, 0ms);
    Patch patch;
    patch.delay = Variation{ConstantLaw{10ms}, {}};
    profile.timeline = {{1s, 0ns, patch, {}}};
    EXPECT_EQ(settled(profile, 1'000'000).up.statistics.received, 2000U);
}

TEST(Predict, SaysThatAnInfiniteDeviationNeverSettles)
{
    Profile profile;
    profile.path.up.delay = Variation{ParetoLaw{.mean = 10ms, .shape = 1.5}, {}};
    const auto prediction = settled(profile, 64'000);
    EXPECT_FALSE(prediction.is_settled());
    EXPECT_NE(why_unsettled(profile.path.up, short_stream, prediction.up, false).find("infinite"),
              std::string::npos);
}

} // namespace
} // namespace hapnet::emulator::tools::predict_test

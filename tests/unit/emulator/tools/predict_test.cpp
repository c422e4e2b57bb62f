// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/predict.hpp"

#include "emulator/tools/describe.hpp"
#include "emulator/tools/learn/likeness.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
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
    // The draws are the same. Only damaged arrivals differ.
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

/// 20 ms for 400 ms, 60 ms for 100 ms, on average; lost are 1 % and 30 %.
Conditions two_regimes()
{
    return {
        .order = Order::free,
        .regimes = {
            {Regime{
                 "good", 400ms, {}, {.loss = {{RandomLoss{1_percent}}}, .delay = constant(20ms)}},
             Regime{"bad",
                    100ms,
                    {},
                    {.loss = {{RandomLoss{30_percent}}}, .delay = constant(60ms)}}}}};
}

TEST(Predict, MixesRegimes)
{
    Profile profile;
    profile.path.up = two_regimes();
    const auto up = predict(profile, {.packets = 1'000'000}, base::Seed{1}).up;
    // A fifth of the time is bad: 0.8 * 1 % + 0.2 * 30 %. 2000 stays: 2.3 % of a share.
    EXPECT_NEAR(up.loss_share(), 0.068, 0.004);
    // 15.02 % of the arrivals took 60 ms: beyond p50, below p90 and p99.
    EXPECT_NEAR(base::to_seconds(up.measured.delay_quantiles->p50), 0.020, 0.001);
    EXPECT_NEAR(base::to_seconds(up.measured.delay_quantiles->p90), 0.060, 0.001);
    EXPECT_NEAR(base::to_seconds(up.measured.delay_quantiles->p99), 0.060, 0.001);
    EXPECT_NEAR(base::to_seconds(up.measured.delay->mean), 0.020 + 0.1502 * 0.040, 0.0004);
}

TEST(Predict, RemembersARegimeAsLongAsItLasts)
{
    Conditions conditions = two_regimes();
    auto all = conditions.regimes.all.get();
    for (Regime& regime : all) regime.own.loss.reset(); // else bad ones are seen less often
    conditions.regimes.all = std::move(all);
    const auto way = played(conditions, 1'000'000, 1ms, 1us);
    // Two states: exp(-t (1 / 400 ms + 1 / 100 ms)).
    for (const auto lag : {10ms, 40ms, 80ms, 200ms}) {
        const double expected = std::exp(-base::to_seconds(lag) / 0.080);
        EXPECT_NEAR(autocorrelation(way, lag).value(), expected, 0.05) << lag.count();
    }
}

TEST(Describe, NamesRegimes)
{
    const auto words = describe(two_regimes(), {});
    const auto has = [&](std::string_view text) {
        return std::ranges::any_of(
            words, [&](const std::string& line) { return line.find(text) != std::string::npos; });
    };
    EXPECT_TRUE(has("regime bad: 20 % of the time, stays of 100 ms on average, then good"));
    EXPECT_TRUE(has("bad: delay: 60 ms"));
    EXPECT_TRUE(has("good: loss random: 1 % lost"));
}

} // namespace
} // namespace hapnet::emulator::tools::predict_test

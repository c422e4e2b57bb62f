// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/delay.hpp"
#include "emulator/core/delay/theory.hpp"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace hapnet::emulator {
namespace {

using namespace std::chrono_literals;

const base::RandomStream stream = base::Seed{42}.stream("up/jitter");

Packet packet(std::uint64_t number)
{
    return {number, 96, static_cast<base::Duration::rep>(number) * base::Duration{1ms}};
}

DelayLaw table_law(base::Duration mean, base::Duration sd, QuantileTable::Unit unit)
{
    return TableLaw{"file", mean, sd,
                    std::make_shared<const QuantileTable>(std::vector<double>{-5e6, 0, 1e7}, unit)};
}

DelayLaw trace_law()
{
    return TraceLaw{
        "file", std::make_shared<const DelayTrace>(std::vector<base::Duration>{10ms, 30ms, 20ms})};
}

std::vector<Variation> every_law()
{
    return {{ConstantLaw{160ms}},
            {UniformLaw{160ms, 15ms}},
            {NormalLaw{0ms, 5ms}},
            {LogNormalLaw{160ms, 80ms}},
            {ExponentialLaw{5ms}},
            {ParetoLaw{20ms, 1.5}},
            {GammaLaw{20ms, 30ms}},
            {GammaLaw{160ms, 1ms}},
            {table_law(50ms, 5ms, QuantileTable::Unit::own)},
            {table_law(0ms, 0ms, QuantileTable::Unit::nanoseconds)},
            {trace_law()},
            {UniformLaw{160ms, 15ms}, 100ms},
            {GammaLaw{20ms, 10ms}, 7ms}};
}

TEST(DelayProcess, AUniformDelayIsItsMeanAndTheUniformNumberOfItsDatagram)
{
    DelayProcess process{{UniformLaw{160ms, 15ms}}, stream};
    for (std::uint64_t n = 0; n < 1000; ++n) {
        const double share = 2.0 * stream.uniform(n) - 1.0;
        EXPECT_EQ(process.on_packet(packet(n)), 160ms + base::Duration{std::llround(share * 15e6)});
    }
}

TEST(DelayProcess, ATraceIsFollowedIndexByIndex)
{
    DelayProcess process{{trace_law()}, stream};
    const std::vector<base::Duration> delays{10ms, 30ms, 20ms};
    for (std::uint64_t n = 0; n < 100; ++n) {
        EXPECT_EQ(process.on_packet(packet(n)), delays[n % 3]);
    }
}

TEST(DelayProcess, WithoutCorrelationADelayDependsOnNothingButItsNumber)
{
    for (const Variation& variation : every_law()) {
        if (variation.correlation_time > 0ms) continue;
        DelayProcess all{variation, stream};
        for (std::uint64_t n = 0; n < 100; ++n) {
            DelayProcess one{variation, stream};
            EXPECT_EQ(one.on_packet(packet(n)), all.on_packet(packet(n)));
        }
    }
}

TEST(DelayProcess, AChangeToTheSameLawChangesNothing)
{
    for (const Variation& variation : every_law()) {
        DelayProcess left_alone{variation, stream};
        DelayProcess changed{variation, stream};
        for (std::uint64_t n = 0; n < 200; ++n) {
            EXPECT_EQ(changed.on_packet(packet(n)), left_alone.on_packet(packet(n)));
            changed.change(variation);
        }
    }
}

TEST(DelayProcess, ACorrelatedProcessGoesOnFromWhereItIsWhenItsLawChanges)
{
    DelayProcess always{{NormalLaw{0ms, 5ms}, 50ms}, stream};
    DelayProcess changed{{GammaLaw{10ms, 5ms}, 50ms}, stream};
    for (std::uint64_t n = 0; n < 100; ++n) {
        if (n == 50) changed.change({NormalLaw{0ms, 5ms}, 50ms});
        const auto delay = changed.on_packet(packet(n));
        const auto expected = always.on_packet(packet(n));
        EXPECT_TRUE(n < 50 || delay == expected) << n;
    }
}

TEST(DelayProcess, ARampOfAGammaLawDrawsWhatANewProcessDraws)
{
    DelayProcess ramped{{GammaLaw{10ms, 5ms}}, stream};
    for (std::uint64_t n = 0; n < 200; ++n) {
        const GammaLaw law{10ms + static_cast<int>(n / 3) * 1us,
                           5ms + static_cast<int>(n / 5) * 1us};
        ramped.change({law});
        DelayProcess fresh{{law}, stream};
        EXPECT_EQ(ramped.on_packet(packet(n)), fresh.on_packet(packet(n))) << n;
    }
}

TEST(DelayProcess, DatagramsThatArriveTogetherShareACorrelatedDelay)
{
    DelayProcess process{{UniformLaw{160ms, 15ms}, 1ms}, stream};
    const auto first = process.on_packet({0, 96, 3s});
    EXPECT_EQ(process.on_packet({1, 96, 3s}), first);
    EXPECT_NE(process.on_packet({2, 96, 3s + 1us}), first);
}

TEST(DelayProcess, TakesTheNearestPossibleLawWhereARampRoundsItOutOfItsRange)
{
    const auto median = [](const DelayLaw& law) { return DelayTheory{law}.quantile(0.5); };
    EXPECT_EQ(median(GammaLaw{10'000'000ns, 100'000'004ns}), median(GammaLaw{10ms, 100ms}));
    EXPECT_EQ(median(table_law(7ns, 0ns, QuantileTable::Unit::own)), 7ns);
}

TEST(DelayProcess, NoDrawIsLongerThanTheLongestDelay)
{
    const auto most = longest_delay;
    EXPECT_EQ((DelayTheory{ParetoLaw{most, 1.0001}}.quantile(1.0 - 0x1p-53)), longest_delay);
    EXPECT_EQ((DelayTheory{NormalLaw{-most, most}}.quantile(0x1p-54)), -longest_delay);
}

TEST(DelayProcess, DrawsTheSameBitsWithEveryCompilerAtEveryOptimisationLevel)
{
    // FNV-1a; the presets compare GCC and Clang, optimised and not.
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const Variation& variation : every_law()) {
        DelayProcess process{variation, stream};
        for (std::uint64_t n = 0; n < 10'000; ++n) {
            const auto delay = process.on_packet(packet(n)).count();
            hash = (hash ^ static_cast<std::uint64_t>(delay)) * 0x100000001b3;
        }
    }
    EXPECT_EQ(hash, 15607745042695196933U);
}

TEST(DelayTheory, StatesMeanAndSdOfEveryLaw)
{
    const auto states = [](const DelayLaw& law, base::Duration mean,
                           std::optional<base::Duration> sd) {
        const DelayTheory theory{law};
        EXPECT_EQ(theory.mean(), mean);
        EXPECT_EQ(theory.sd(), sd);
    };
    states(ConstantLaw{160ms}, 160ms, 0ms);
    states(UniformLaw{160ms, 15ms}, 160ms, 8'660'254ns); // 15 ms / sqrt(3)
    states(NormalLaw{-1ms, 5ms}, -1ms, 5ms);
    states(LogNormalLaw{160ms, 80ms}, 160ms, 80ms);
    states(ExponentialLaw{5ms}, 5ms, 5ms);
    states(ParetoLaw{15ms, 3.0}, 15ms, 8'660'254ns); // 15 ms / sqrt(3 * 1)
    states(ParetoLaw{15ms, 2.0}, 15ms, std::nullopt);
    states(GammaLaw{20ms, 10ms}, 20ms, 10ms);
    states(table_law(50ms, 5ms, QuantileTable::Unit::own), 50ms, 5ms);
    states(trace_law(), 20ms, 8'164'966ns); // 10 ms sqrt(2 / 3)
}

TEST(DelayTheory, MomentsAreThoseOfTheQuantiles)
{
    for (const Variation& variation : every_law()) {
        const auto* pareto = std::get_if<ParetoLaw>(&variation.law);
        if (pareto && pareto->shape <= 2.0) continue;
        DelayTheory theory{variation.law};
        constexpr int parts = 20'000;
        double sum = 0.0; // of the distances from the mean
        double squares = 0.0;
        for (int i = 0; i < parts; ++i) {
            const auto distance = theory.quantile((i + 0.5) / parts) - theory.mean();
            sum += base::to_seconds(distance);
            squares += base::to_seconds(distance) * base::to_seconds(distance);
        }
        // Midpoints leave out the last half part of a tail: less than 0.5 % of the moments here.
        const double sd = std::sqrt(squares / parts);
        EXPECT_NEAR(sum / parts, 0.0, 5e-3 * sd);
        EXPECT_NEAR(sd, base::to_seconds(theory.sd().value()), 5e-3 * sd);
    }
}

TEST(DelayTheory, TheShareBelowAQuantileIsItsProbability)
{
    for (const Variation& variation : every_law()) {
        DelayTheory theory{variation.law};
        if (theory.constant() || std::holds_alternative<TraceLaw>(variation.law)) continue;
        for (const double q : {0.1, 0.25, 0.5, 0.99, 0.9999}) {
            EXPECT_NEAR(theory.share_below(theory.quantile(q)), q, 1e-6);
        }
    }
    DelayTheory trace{trace_law()};
    EXPECT_EQ(trace.quantile(0.5), 20ms);
    EXPECT_NEAR(trace.share_below(30ms), 2.0 / 3.0, 1e-15);
    EXPECT_EQ(trace.share_below(10ms), 0.0);
    EXPECT_EQ(trace.share_below(31ms), 1.0);
}

TEST(DelayTheory, StatesWhatIsClippedBelowZero)
{
    EXPECT_EQ(clipped_share(ConstantLaw{5ms}, ConstantLaw{-6ms}), 1.0);
    EXPECT_EQ(clipped_share(ConstantLaw{5ms}, UniformLaw{0ms, 5ms}), 0.0);
    EXPECT_NEAR(clipped_share(ConstantLaw{5ms}, UniformLaw{0ms, 10ms}), 0.25, 1e-6);
    EXPECT_NEAR(clipped_share(NormalLaw{10ms, 5ms}, ConstantLaw{0ms}), 0.0227501, 1e-6);
    // Normal 10 ms and sd 3 ms with sd 4 ms: normal with sd 5 ms.
    EXPECT_NEAR(clipped_share(NormalLaw{10ms, 3ms}, NormalLaw{0ms, 4ms}), 0.0227501, 1e-4);
}

TEST(Law, IsComparedByWhatItsTableOrTraceHolds)
{
    EXPECT_EQ(table_law(0ms, 1ms, QuantileTable::Unit::own),
              table_law(0ms, 1ms, QuantileTable::Unit::own));
    EXPECT_NE(table_law(0ms, 1ms, QuantileTable::Unit::own),
              table_law(0ms, 1ms, QuantileTable::Unit::nanoseconds));
    EXPECT_EQ(trace_law(), trace_law());
    EXPECT_NE(trace_law(),
              (DelayLaw{TraceLaw{"file", std::make_shared<const DelayTrace>(
                                             std::vector<base::Duration>{10ms, 30ms})}}));
}

TEST(Law, SaysWhatIsWrongWithIt)
{
    const auto says = [](const Variation& variation) {
        const auto valid = validate(variation);
        return valid ? "nothing" : valid.error().message;
    };
    for (const Variation& variation : every_law()) EXPECT_EQ(says(variation), "nothing");
    EXPECT_EQ(says({UniformLaw{0ms, -1ms}}), "half_width must be a time from 0ms to 1000000s");
    EXPECT_EQ(says({NormalLaw{0ms, -1ms}}), "sd must be a time from 0ms to 1000000s");
    EXPECT_EQ(says({NormalLaw{longest_delay + 1ns, 1ms}}),
              "mean must be a time from -1000000s to 1000000s");
    EXPECT_EQ(says({LogNormalLaw{0ms, 1ms}}), "mean must be more than 0");
    EXPECT_EQ(says({ExponentialLaw{-1ms}}), "mean must be a time from 0ms to 1000000s");
    EXPECT_EQ(says({ParetoLaw{1ms, 1.0}}), "shape must be more than 1, or there is no mean");
    EXPECT_EQ(says({ParetoLaw{1ms, std::nan("")}}),
              "shape must be more than 1, or there is no mean");
    EXPECT_EQ(says({GammaLaw{1ms, 0ms}}), "sd must be more than 0");
    EXPECT_EQ(says({GammaLaw{1ms, 11ms}}), "sd must be at most 10 times the mean");
    EXPECT_EQ(says({table_law(0ms, 0ms, QuantileTable::Unit::own)}), "sd must be more than 0");
    EXPECT_EQ(says({table_law(1ms, 0ms, QuantileTable::Unit::nanoseconds)}),
              "sd must be more than 0");
    EXPECT_EQ(says({NormalLaw{0ms, 1ms}, -1ms}), "correlation_time must not be negative");
    EXPECT_EQ(says({trace_law(), 1ms}),
              "correlation_time is not for traces: they are correlated as recorded");
}

} // namespace
} // namespace hapnet::emulator

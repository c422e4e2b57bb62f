// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/random.hpp"
#include "proto/base/text.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace hapnet::base {
namespace {

constexpr std::uint64_t cases = 20'000;

TEST(Text, EveryPrintedDurationReadsBackAsItself)
{
    const RandomStream stream = Seed{1}.stream("durations");
    for (std::uint64_t i = 0; i < cases; ++i) {
        // All magnitudes from 1 ns to 10^6 s are equally likely; every second number is round.
        auto count = static_cast<Duration::rep>(std::pow(10.0, 15.0 * stream.uniform(i)));
        if (i % 2 == 0) count -= count % (i % 4 == 0 ? 1'000 : 1'000'000);
        const Duration duration{count};
        const auto text = to_text(duration);
        const auto read = parse_duration(text);
        ASSERT_TRUE(read) << text;
        ASSERT_EQ(*read, duration) << text;
    }
}

TEST(Text, EveryPrintedShareReadsBackAsItself)
{
    const RandomStream stream = Seed{1}.stream("shares");
    for (std::uint64_t i = 0; i < cases; ++i) {
        double fraction = stream.uniform(i);
        if (i % 4 == 1) fraction = std::round(fraction * 1e4) / 1e4;
        if (i % 4 == 2) fraction = std::pow(fraction, i % 64 == 2 ? 1000.0 : 30.0);
        if (i % 4 == 3) fraction = 1.0 - std::pow(fraction, 30.0);
        const Probability share = Probability::from_fraction(fraction).value();
        const auto text = to_text(share);
        const auto read = parse_probability(text);
        ASSERT_TRUE(read) << text;
        ASSERT_EQ(*read, share) << text << " " << fraction;
    }
}

TEST(Text, NoTextWhateverItHoldsIsReadAsSomethingOutOfRange)
{
    constexpr std::string_view alphabet = "0123456789....-+eEnaifmsun% x";
    const RandomStream stream = Seed{1}.stream("noise");
    for (std::uint64_t i = 0; i < cases; ++i) {
        std::string text;
        const auto length = stream.below(12, i);
        for (std::uint32_t k = 1; k <= length; ++k) {
            text += alphabet[stream.below(static_cast<std::uint32_t>(alphabet.size()), i, k)];
        }
        const auto duration = parse_duration(text);
        ASSERT_TRUE(!duration || (*duration >= Duration{0} && *duration <= std::chrono::hours{278}))
            << text;
        std::ignore = parse_probability(text); // its type holds the range
        const auto count = parse_count(text, 1000);
        ASSERT_TRUE(!count || *count <= 1000) << text;
    }
}

} // namespace
} // namespace hapnet::base

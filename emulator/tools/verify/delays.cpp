// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/delays.hpp"

#include "emulator/core/delay/delay.hpp"
#include "emulator/tools/verify/draws.hpp"
#include "emulator/tools/verify/tails.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <cstddef>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

using Delays = std::vector<base::Duration>;

constexpr std::size_t delays_max = 1'000'000; // more do not improve a test noticeably

bool is_constant(const Variation& variation)
{
    return std::holds_alternative<ConstantLaw>(variation.law) || is_nothing(variation);
}

bool is_traced(const Variation& variation)
{
    return std::holds_alternative<TraceLaw>(variation.law);
}

Delays delays_of(std::span<const Fate> fates, std::size_t stride)
{
    Delays delays;
    for (std::size_t i = 0; i < fates.size() && delays.size() < delays_max; i += stride) {
        if (!fates[i].drop) delays.push_back(fates[i].delay);
    }
    return delays;
}

/// Returns delays drawn from the same laws without their correlation, with a fixed seed.
Delays drawn(const Conditions& conditions, std::size_t count)
{
    const base::Seed seed{0x5eed'0f'c0ffee};
    DelayProcess delay{{conditions.delay.law}, seed.stream("verify/delay")};
    DelayProcess jitter{{conditions.jitter.law}, seed.stream("verify/jitter")};
    Delays delays;
    for (std::uint64_t number = 0; number < count; ++number) {
        const Packet packet{.number = number};
        delays.push_back(
            std::max(delay.on_packet(packet) + jitter.on_packet(packet), base::Duration{0}));
    }
    return delays;
}

TestResult verify_constant(std::span<const Fate> fates, base::Duration expected)
{
    const auto delays = delays_of(fates, 1);
    const auto wrong = std::count_if(delays.begin(), delays.end(),
                                     [&](base::Duration delay) { return delay != expected; });
    return exactly(
        "delay", wrong == 0,
        fmt::format("{} of {} delays are not {} ns", wrong, delays.size(), expected.count()));
}

} // namespace

std::vector<TestResult> verify_delays(const Conditions& conditions, std::span<const Fate> fates,
                                      std::optional<base::Duration> spacing, double alpha)
{
    if (is_constant(conditions.delay) && is_constant(conditions.jitter)) {
        const auto expected = drawn(conditions, 1).front();
        return {verify_constant(fates, expected)};
    }
    if (is_traced(conditions.delay) || is_traced(conditions.jitter)) {
        return {unable("delay law", "a trace has no law: compare with the seed instead")};
    }
    const auto memory =
        std::max(conditions.delay.correlation_time, conditions.jitter.correlation_time);
    if (memory == base::Duration{0}) {
        const auto delays = delays_of(fates, 1);
        return {test_same_law(delays, drawn(conditions, delays.size()), alpha),
                test_correlation(rank_scores(delays), 0.0, alpha)};
    }
    if (!spacing) {
        return {unable("delay law", "delays are correlated in time, and the spacing of the "
                                    "datagrams is not known")};
    }
    // exp(-5) = 0.7 % of the correlation is left.
    const auto stride = static_cast<std::size_t>(5 * memory / *spacing) + 1;
    const auto delays = delays_of(fates, stride);
    return {test_same_law(delays, drawn(conditions, delays.size()), alpha)};
}

} // namespace hapnet::emulator::tools

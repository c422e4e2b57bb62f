// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/exact.hpp"

#include "emulator/tools/verify/tails.hpp"

#include <algorithm>
#include <cstddef>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

/// Counts deviations. The statistic is their number; the sentence names the first.
TestResult count_deviations(std::string name, std::size_t count, auto&& deviates,
                            std::string_view what)
{
    std::size_t deviations = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (!deviates(i)) continue;
        if (deviations++ == 0) first = i;
    }
    auto result = exactly(std::move(name), deviations == 0, "");
    result.statistic = static_cast<double>(deviations);
    result.sentence = deviations == 0 ? fmt::format("{} {}, none deviates", count, what)
                                      : fmt::format("{} of {} {} deviate, first number {}",
                                                    deviations, count, what, first);
    return result;
}

TestResult wrong_number(std::string name, std::size_t expected, std::size_t observed)
{
    return exactly(std::move(name), false,
                   fmt::format("{} datagrams expected, {} observed", expected, observed));
}

} // namespace

TestResult test_equal(std::span<const Fate> expected, std::span<const Fate> observed)
{
    if (expected.size() != observed.size()) {
        return wrong_number("fates", expected.size(), observed.size());
    }
    return count_deviations(
        "fates", expected.size(), [&](std::size_t i) { return !(expected[i] == observed[i]); },
        "fates");
}

TestResult test_same_losses(std::span<const std::uint8_t> expected,
                            std::span<const std::uint8_t> observed)
{
    if (expected.size() != observed.size()) {
        return wrong_number("losses", expected.size(), observed.size());
    }
    return count_deviations(
        "losses", expected.size(), [&](std::size_t i) { return expected[i] != observed[i]; },
        "datagrams");
}

TestResult test_blocks(std::span<const std::uint8_t> lost, const ExactBlocks& law)
{
    const std::size_t blocks = lost.size() / law.of;
    if (blocks == 0) return unable("blocks", "not one whole block was observed");
    const auto deviates = [&](std::size_t block) {
        const auto one = lost.subspan(block * law.of, law.of);
        return std::count(one.begin(), one.end(), std::uint8_t{1}) !=
               static_cast<std::ptrdiff_t>(law.lost);
    };
    return count_deviations("blocks", blocks, deviates,
                            fmt::format("blocks of {} with {} losses", law.of, law.lost));
}

TestResult test_places(std::span<const std::uint8_t> lost, const ExactBlocks& law, double alpha)
{
    const std::size_t of = law.of;
    const std::size_t whole = lost.size() / of;
    const auto blocks = static_cast<double>(whole);
    const double expected = blocks * law.lost / law.of;
    if (of < 2 || law.lost >= law.of || std::min(expected, blocks - expected) < 5.0) {
        return unable("places", "too few blocks to compare the places in them");
    }
    std::vector<double> losses(of);
    for (std::size_t i = 0; i < whole * of; ++i) losses[i % of] += lost[i];
    double sum = 0.0;
    for (const double one : losses) sum += (one - expected) * (one - expected);
    // As each block loses its exact number, the places have one degree of freedom less.
    const auto degrees = static_cast<double>(of - 1);
    const double variance = expected * (1.0 - expected / blocks) * law.of / degrees;
    const double chi_square = sum / variance;
    auto result = by_chance("places", chi_square, chi_square_tail(chi_square, degrees), alpha);
    result.sentence = fmt::format("{:.0f} losses expected at each of {} places in a block; "
                                  "chi-square {:.1f}",
                                  expected, of, chi_square);
    return result;
}

TestResult test_bursts(std::span<const std::uint8_t> lost, const RecurringBursts& law)
{
    const std::size_t of = law.of;
    if (lost.size() < 2 * of) return unable("bursts", "fewer than two periods were observed");
    // The first visible beginning of a burst. A law that loses all datagrams has none, and needs
    // none.
    std::size_t begin = 1;
    while (begin < of && !(lost[begin] != 0 && lost[begin - 1] == 0)) ++begin;
    if (law.phase) begin = *law.phase;
    const std::size_t shift = of - begin % of;
    return count_deviations(
        "bursts", lost.size(),
        [&](std::size_t i) { return (lost[i] != 0) != ((i + shift) % of < law.lost); },
        "datagrams");
}

} // namespace hapnet::emulator::tools

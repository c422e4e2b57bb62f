// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/losses.hpp"

#include "emulator/tools/verify/tails.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

double ratio(double a, double b) { return b > 0.0 ? a / b : 0.0; }

std::string shares(double expected, double observed, std::uint64_t datagrams)
{
    return fmt::format("{:.4f} % expected, {:.4f} % of {} datagrams lost", 100.0 * expected,
                       100.0 * observed, datagrams);
}

constexpr double expected_min = 5.0; // fewest expected in a bin of a chi-square test

/// The result of a chi-square test once its bins have been filled.
struct ChiSquare {
    double sum = 0.0;
    int bins = 0;

    void add(double observed, double expected)
    {
        sum += (observed - expected) * (observed - expected) / expected;
        ++bins;
    }
};

/// Compares the lengths of runs. Neighbouring lengths share a bin until enough are expected in it;
/// the last bin is open.
ChiSquare compare_lengths(const std::vector<std::uint64_t>& runs, const RunLengths& law,
                          double count)
{
    ChiSquare result;
    double observed_left = count;
    double expected_left = count;
    double observed = 0.0;
    double expected = 0.0;
    for (std::size_t i = 0; i + 1 < law.at_least.size(); ++i) {
        observed += i < runs.size() ? static_cast<double>(runs[i]) : 0.0;
        expected += count * (law.at_least[i] - law.at_least[i + 1]);
        if (expected < expected_min) continue;
        if (expected_left - expected < expected_min) break;
        result.add(observed, expected);
        observed_left -= observed;
        expected_left -= expected;
        observed = expected = 0.0;
    }
    result.add(observed_left, expected_left);
    return result;
}

} // namespace

TestResult test_count(const LossTally& tally, double share, double alpha)
{
    const auto n = static_cast<double>(tally.datagrams());
    if (tally.datagrams() == 0) return unable("losses", "no datagram was observed");
    const double observed = static_cast<double>(tally.losses()) / n;
    auto result = by_chance("losses", static_cast<double>(tally.losses()),
                            binomial_two_sided(tally.losses(), tally.datagrams(), share), alpha);
    result.sentence = shares(share, observed, tally.datagrams());
    return result;
}

TestResult test_share(const LossTally& tally, const LossTheory& theory, double alpha)
{
    const auto n = static_cast<double>(tally.datagrams());
    const double observed = ratio(static_cast<double>(tally.losses()), n);
    const double share = theory.share;
    const auto text = shares(share, observed, tally.datagrams());
    if (share <= 0.0 || share >= 1.0) return exactly("losses", observed == share, text);
    constexpr double worth_min = 100.0; // independent losses, enough for the normal law
    const double worth =
        n * std::min(share, 1.0 - share) / std::max(theory.variance_inflation, 1.0);
    if (worth < worth_min) {
        return unable("losses", fmt::format("{}; about {:.0f} datagrams are needed to tell", text,
                                            std::ceil(n * worth_min / std::max(worth, 1e-9))));
    }
    const double sd = std::sqrt(share * (1.0 - share) * theory.variance_inflation / n);
    const double z = (observed - share) / sd;
    auto result = by_chance("losses", z, normal_two_sided(z), alpha);
    result.sentence =
        fmt::format("{}: {:+.2f} standard deviations, losses in bursts counted in", text, z);
    return result;
}

TestResult test_independence(const LossTally& tally, double alpha)
{
    const auto pairs = [&](bool first, bool second) {
        return static_cast<double>(tally.pairs(first, second));
    };
    const double lost = pairs(true, false) + pairs(true, true);
    const double passed = pairs(false, false) + pairs(false, true);
    const double next_lost = pairs(false, true) + pairs(true, true);
    const double n = lost + passed;
    const double product = lost * passed * next_lost * (n - next_lost);
    if (std::min(lost, passed) * std::min(next_lost, n - next_lost) < expected_min * n) {
        return unable("independence", "too few neighbouring losses, or too few without");
    }
    const double cross =
        pairs(true, true) * pairs(false, false) - pairs(true, false) * pairs(false, true);
    const double chi_square = cross / product * cross * n;
    auto result = by_chance("independence", chi_square, chi_square_tail(chi_square, 1.0), alpha);
    result.sentence =
        fmt::format("{:.4f} % lost after a loss and {:.4f} % after none, which should be equal",
                    100.0 * pairs(true, true) / lost, 100.0 * pairs(false, true) / passed);
    return result;
}

TestResult test_number_of_runs(const LossTally& tally, double alpha)
{
    const auto n = static_cast<double>(tally.datagrams());
    const auto lost = static_cast<double>(tally.losses());
    const double passed = n - lost;
    if (std::min(lost, passed) < 20.0) { // with fewer the law is not normal enough
        return unable("number of runs", "fewer than 20 losses, or than 20 datagrams that pass");
    }
    const double mean = 2.0 * lost * passed / n + 1.0;
    const double sd = std::sqrt((mean - 1.0) * (mean - 2.0) / (n - 1.0));
    const auto changes = tally.pairs(true, false) + tally.pairs(false, true);
    const double runs = 1.0 + static_cast<double>(changes);
    const double z = (runs - mean) / sd;
    auto result = by_chance("number of runs", z, normal_two_sided(z), alpha);
    result.sentence =
        fmt::format("{:.0f} expected, {:.0f} observed: {:+.2f} standard deviations", mean, runs, z);
    return result;
}

TestResult test_run_lengths(const LossTally& tally, const RunLengths& law, double alpha)
{
    double count = 0.0;
    double losses = 0.0;
    for (std::size_t i = 0; i < tally.runs().size(); ++i) {
        const auto runs = static_cast<double>(tally.runs()[i]);
        count += runs;
        losses += runs * static_cast<double>(i + 1);
    }
    const ChiSquare test = compare_lengths(tally.runs(), law, count);
    if (count < 2.0 * expected_min) {
        return unable("run lengths", fmt::format("{:.0f} run{} of losses: too few", count,
                                                 count == 1.0 ? "" : "s"));
    }
    double mean = 0.0;
    for (const double at_least : law.at_least) mean += at_least;
    const auto text = fmt::format("{:.0f} runs of losses with a mean of {:.3f}, {:.3f} expected",
                                  count, losses / count, mean);
    if (test.bins < 2) {
        // All runs have one length, or nearly all.
        return exactly("run lengths", test.sum < 1.0, text);
    }
    const double degrees = test.bins - 1;
    auto result = by_chance("run lengths", test.sum, chi_square_tail(test.sum, degrees), alpha);
    result.sentence = fmt::format("{}; chi-square {:.1f} over {} bins", text, test.sum, test.bins);
    return result;
}

TestResult test_unrelated(const PairTally& tally, double memory, double alpha)
{
    const auto n = static_cast<double>(tally.datagrams);
    const auto first = static_cast<double>(tally.first);
    const auto second = static_cast<double>(tally.second);
    const double product = first * (n - first) * second * (n - second);
    if (tally.datagrams == 0 ||
        std::min(first, n - first) * std::min(second, n - second) < expected_min * n) {
        return unable("directions", "too few losses to compare those of the directions");
    }
    const double correlation =
        (static_cast<double>(tally.both) * n - first * second) / std::sqrt(product);
    const double inflation = (1.0 + memory) / (1.0 - memory);
    const double z = correlation * std::sqrt(n / std::max(inflation, 1.0));
    auto result = by_chance("directions", correlation, normal_two_sided(z), alpha);
    result.sentence =
        fmt::format("the losses of up and down have a correlation of {:+.5f}: {:+.2f} "
                    "standard deviations from none",
                    correlation, z);
    return result;
}

} // namespace hapnet::emulator::tools

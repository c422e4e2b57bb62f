// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/learn/loss_runs.hpp"

#include "emulator/tools/verify/tails.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::emulator::tools {

namespace {

using Row = LossChain::Row;

/// Returns the share that moves on to each state with a datagram that is lost, or that arrives.
Row stepped(const LossChain& chain, const Row& from, bool is_lost)
{
    Row to{};
    for (std::size_t j = 0; j < to.size(); ++j) {
        for (std::size_t i = 0; i < from.size(); ++i) to[j] += from[i] * chain.steps[i][j];
        to[j] *= is_lost ? chain.loses[j] : 1.0 - chain.loses[j];
    }
    return to;
}

double sum_of(const Row& row)
{
    double sum = 0.0;
    for (const double one : row) sum += one;
    return sum;
}

/// Returns the ratio of the variance of a count of runs to that of independent ones: 1 + 2 times
/// the correlations of their lengths, up to the first that is below the noise.
double inflation_of(const std::vector<std::size_t>& lengths)
{
    constexpr std::size_t lags_max = 100;
    const auto n = static_cast<double>(lengths.size());
    std::vector<double> logs;
    double mean = 0.0;
    for (const std::size_t length : lengths) {
        logs.push_back(base::log(static_cast<double>(length)));
        mean += logs.back() / n;
    }
    const auto covariance = [&](std::size_t lag) {
        double sum = 0.0;
        for (std::size_t i = lag; i < logs.size(); ++i) {
            sum += (logs[i] - mean) * (logs[i - lag] - mean);
        }
        return sum;
    };
    const double variance = covariance(0);
    if (variance < 1e-9 * n) return 1.0; // all values are equal
    double inflation = 1.0;
    for (std::size_t lag = 1; lag <= std::min(lags_max, logs.size() / 2); ++lag) {
        const double correlation = covariance(lag) / variance;
        if (correlation < 2.0 / std::sqrt(n)) break;
        inflation += 2.0 * correlation;
    }
    return inflation;
}

} // namespace

std::vector<LossRun> runs_of(const std::vector<bool>& lost)
{
    std::vector<LossRun> runs;
    for (const bool is_lost : lost) {
        if (runs.empty() || runs.back().is_lost != is_lost) runs.push_back({is_lost, 0});
        ++runs.back().length;
    }
    return runs;
}

std::vector<double> run_lengths(const LossChain& chain, bool of_losses, std::size_t most)
{
    Row row{}; // state of the datagram before a run
    for (std::size_t i = 0; i < row.size(); ++i) {
        row[i] = chain.shares[i] * (of_losses ? 1.0 - chain.loses[i] : chain.loses[i]);
    }
    row = stepped(chain, row, of_losses);
    const double begin = sum_of(row);
    if (begin <= 0.0) return {};
    for (double& one : row) one /= begin;
    std::vector<double> at_least;
    for (std::size_t length = 0; length < most; ++length) {
        at_least.push_back(sum_of(row));
        row = stepped(chain, row, of_losses);
    }
    return at_least;
}

std::optional<double> test_runs(const std::vector<LossRun>& runs, const LossChain& chain,
                                bool of_losses)
{
    constexpr std::size_t length_max = 100'000; // longer ones share the last class
    constexpr double expected_min = 5.0;
    constexpr double classes_max = 20.0;
    std::vector<std::size_t> lengths;
    for (std::size_t i = 1; i + 1 < runs.size(); ++i) {
        if (runs[i].is_lost == of_losses) lengths.push_back(runs[i].length);
    }
    if (lengths.empty()) return std::nullopt;
    const double inflation = inflation_of(lengths);
    std::sort(lengths.begin(), lengths.end());
    const auto n = static_cast<double>(lengths.size());
    const auto at_least = run_lengths(chain, of_losses, std::min(lengths.back(), length_max) + 1);
    if (at_least.empty()) return 0.0; // the chain has no such run
    const double expected_each = std::max(expected_min, n / classes_max);
    double statistic = 0.0;
    int classes = 0;
    auto counted = lengths.begin();
    double from = 1.0; // value of at_least at the beginning of the class
    const auto close = [&](std::vector<std::size_t>::iterator end, double to) {
        const double expected = n * (from - to);
        const auto observed = static_cast<double>(end - counted);
        statistic += (observed - expected) * (observed - expected) / expected;
        ++classes;
        counted = end;
        from = to;
    };
    for (std::size_t length = 1; length < at_least.size(); ++length) {
        const double to = at_least[length];
        // The remainder must also be large enough for a class.
        if (n * (from - to) < expected_each || n * to < expected_min) continue;
        close(std::upper_bound(counted, lengths.end(), length), to);
    }
    close(lengths.end(), 0.0);
    if (classes < 2) return std::nullopt;
    return chi_square_tail(statistic / inflation, classes - 1.0);
}

} // namespace hapnet::emulator::tools

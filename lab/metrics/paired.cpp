// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/paired.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace hapnet::lab::metrics {

double median_of(std::vector<double> values)
{
    base::ensure(!values.empty());
    std::ranges::sort(values);
    const std::size_t middle = values.size() / 2;
    if (values.size() % 2 == 1) return values[middle];
    return (values[middle - 1] + values[middle]) / 2.0;
}

Interval interval_of_mean(std::span<const double> values)
{
    base::ensure(!values.empty());
    if (values.size() < interval_seeds_min) {
        const auto [least, most] = std::ranges::minmax(values);
        return {least, most};
    }
    const auto count = static_cast<double>(values.size());
    std::vector<double> means;
    for (const auto& weights : drawn_weights(values.size(), values.size()))
        means.push_back(std::inner_product(values.begin(), values.end(), weights.begin(), 0.0) /
                        count);
    return interval_of(std::move(means), static_cast<std::uint32_t>(values.size()));
}

double quantile_of(std::vector<double> values, double share)
{
    base::ensure(!values.empty());
    std::ranges::sort(values);
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    return values[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
}

Interval interval_of_quantile(std::vector<double> values, double share)
{
    constexpr double tail = 0.025;
    constexpr double infinite = std::numeric_limits<double>::infinity();
    std::ranges::sort(values);
    const auto count = static_cast<double>(values.size());
    // The sum is computed from logarithms: with a thousand values the first probabilities are too
    // small for a double.
    const auto chance_of = [&](double k) {
        return std::exp(std::lgamma(count + 1.0) - std::lgamma(k + 1.0) -
                        std::lgamma(count - k + 1.0) + k * std::log(share) +
                        (count - k) * std::log1p(-share));
    };
    Interval interval{-infinite, infinite};
    double fewer = 0.0; // probability that fewer than `rank` values lie below the true quantile
    for (std::size_t rank = 1; rank <= values.size(); ++rank) {
        fewer += chance_of(static_cast<double>(rank - 1));
        if (fewer <= tail) interval.low = values[rank - 1];
        if (fewer < 1.0 - tail) continue;
        interval.high = values[rank - 1];
        break;
    }
    return interval;
}

double sign_test(std::uint32_t above, std::uint32_t below)
{
    const std::uint32_t count = above + below;
    const std::uint32_t fewer = std::min(above, below);
    double one = 1.0; // the probability of exactly k signs below, from k = 0 on
    for (std::uint32_t i = 0; i < count; ++i) one /= 2.0;
    double sum = 0.0;
    for (std::uint32_t k = 0; k <= fewer; ++k) {
        sum += one;
        one *= static_cast<double>(count - k) / static_cast<double>(k + 1);
    }
    return std::min(2.0 * sum, 1.0);
}

PairedTest paired_test(std::span<const double> a, std::span<const double> b)
{
    base::ensure(a.size() == b.size() && !a.empty());
    PairedTest test{.seeds = static_cast<std::uint32_t>(a.size())};
    std::vector<double> apart;
    for (std::size_t i = 0; i < a.size(); ++i) {
        apart.push_back(a[i] - b[i]);
        test.above += a[i] > b[i] ? 1U : 0U;
        test.below += a[i] < b[i] ? 1U : 0U;
    }
    test.median = median_of(apart);
    test.p = sign_test(test.above, test.below);
    const auto stream = base::Seed{1}.stream("bootstrap of differences");
    std::vector<double> medians, drawn(apart.size());
    for (std::uint32_t replicate = 0; replicate < bootstrap_replicates; ++replicate) {
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            const auto seed = stream.below(test.seeds, i, replicate);
            drawn[i] = apart[static_cast<std::size_t>(seed)];
        }
        medians.push_back(median_of(drawn));
    }
    test.interval = interval_of(std::move(medians), test.seeds);
    return test;
}

} // namespace hapnet::lab::metrics

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/paired.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
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

double sign_test(std::uint32_t above, std::uint32_t below)
{
    const std::uint32_t count = above + below;
    const std::uint32_t fewer = std::min(above, below);
    double one = 1.0; // the probability of k of them, from k = 0 on
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

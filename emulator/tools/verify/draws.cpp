// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/draws.hpp"

#include "emulator/tools/verify/tails.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator::tools {

namespace {

constexpr std::size_t delays_min = 100; // with fewer the laws of the statistics are not valid

TestResult too_few(std::string name)
{
    return unable(std::move(name), fmt::format("fewer than {} delays", delays_min));
}

} // namespace

TestResult test_same_law(std::vector<base::Duration> a, std::vector<base::Duration> b, double alpha)
{
    if (std::min(a.size(), b.size()) < delays_min) return too_few("delay law");
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    const auto size_a = static_cast<double>(a.size());
    const auto size_b = static_cast<double>(b.size());
    double distance = 0.0;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const base::Duration value = std::min(a[i], b[j]);
        while (i < a.size() && a[i] == value) ++i;
        while (j < b.size() && b[j] == value) ++j;
        distance = std::max(
            distance, std::abs(static_cast<double>(i) / size_a - static_cast<double>(j) / size_b));
    }
    const double worth = size_a * size_b / (size_a + size_b);
    auto result = by_chance("delay law", distance, kolmogorov_tail(distance, worth), alpha);
    result.sentence =
        fmt::format("the distribution of {} delays and that of {} drawn for comparison are {:.5f} "
                    "apart at most (Kolmogorov-Smirnov)",
                    a.size(), b.size(), distance);
    return result;
}

std::vector<double> rank_scores(const std::vector<base::Duration>& delays)
{
    std::vector<std::size_t> order(delays.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return delays[a] < delays[b]; });
    std::vector<double> scores(delays.size());
    for (std::size_t i = 0; i < order.size();) {
        std::size_t next = i;
        while (next < order.size() && delays[order[next]] == delays[order[i]]) ++next;
        const double rank = 0.5 * static_cast<double>(i + next);
        const double score = normal_score(rank / static_cast<double>(order.size()));
        for (; i < next; ++i) scores[order[i]] = score;
    }
    return scores;
}

TestResult test_correlation(std::span<const double> scores, double rho, double alpha)
{
    if (scores.size() < delays_min) return too_few("delay correlation");
    const double rest = std::sqrt(1.0 - rho * rho);
    double products = 0.0;
    double with_innovation = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i + 1 < scores.size(); ++i) {
        const double innovation = (scores[i + 1] - rho * scores[i]) / rest;
        products += scores[i] * scores[i + 1];
        with_innovation += scores[i] * innovation;
        squares += scores[i] * scores[i];
    }
    // The innovations are standard normal and independent of the past.
    const double z = with_innovation / std::sqrt(squares);
    auto result = by_chance("delay correlation", products / squares, normal_two_sided(z), alpha);
    result.sentence =
        fmt::format("neighbouring delays have a correlation of {:.4f}, {:.4f} expected: {:+.2f} "
                    "standard deviations",
                    products / squares, rho, z);
    return result;
}

} // namespace hapnet::emulator::tools

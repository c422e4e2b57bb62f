// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/similarity.hpp"

#include "lab/metrics/ticks.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace hapnet::lab::metrics {

namespace {

constexpr double weakest_felt_n = 0.05;
constexpr double strongest_n = 3.3;
constexpr double window_s = 0.050;
constexpr double lag_max_s = 0.5;
constexpr double coarse_s = 0.010; // step of the coarse search for the lag
constexpr double length_min_s = 1.0;

/// Sums over pairs of two signals, from which their means and variances follow.
struct Pairs {
    double count = 0.0;
    double a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;

    void add(double x, double y)
    {
        count += 1.0;
        a += x;
        b += y;
        aa += x * x;
        bb += y * y;
        ab += x * y;
    }
    [[nodiscard]] double covariance() const { return ab / count - a / count * (b / count); }
    [[nodiscard]] double variance_a() const { return aa / count - a / count * (a / count); }
    [[nodiscard]] double variance_b() const { return bb / count - b / count * (b / count); }
};

std::vector<double> compressed(std::span<const double> force)
{
    std::vector<double> sensation;
    sensation.reserve(force.size());
    for (const double f : force) {
        sensation.push_back(base::log1p(std::abs(f) / weakest_felt_n));
    }
    return sensation;
}

/// Returns the correlation of `a` with `b` `lag` samples later, at every `stride`-th sample; -1
/// when one of them is constant.
double correlation(std::span<const double> a, std::span<const double> b, std::size_t lag,
                   std::size_t stride)
{
    Pairs pairs;
    for (std::size_t i = 0; i + lag < b.size(); i += stride) pairs.add(a[i], b[i + lag]);
    const double square = pairs.variance_a() * pairs.variance_b();
    return square > 0.0 ? pairs.covariance() / std::sqrt(square) : -1.0;
}

struct Range {
    std::size_t first, last, stride;
};

std::size_t best_lag(std::span<const double> a, std::span<const double> b, const Range& lags,
                     std::size_t stride)
{
    std::size_t best = lags.first;
    double highest = -2.0;
    for (std::size_t lag = lags.first; lag <= lags.last; lag += lags.stride) {
        const double value = correlation(a, b, lag, stride);
        if (value <= highest) continue;
        highest = value;
        best = lag;
    }
    return best;
}

/// Returns the structural similarity of Wang et al., IEEE Transactions on Image Processing 13(4),
/// 2004, with its constants.
double structural_similarity(const Pairs& pairs)
{
    const double range = base::log1p(strongest_n / weakest_felt_n);
    const double c1 = (0.01 * range) * (0.01 * range);
    const double c2 = (0.03 * range) * (0.03 * range);
    const double a = pairs.a / pairs.count;
    const double b = pairs.b / pairs.count;
    const double means = (2.0 * a * b + c1) / (a * a + b * b + c1);
    const double spreads =
        (2.0 * pairs.covariance() + c2) / (pairs.variance_a() + pairs.variance_b() + c2);
    return means * spreads;
}

} // namespace

std::optional<Similarity> similarity_of(std::span<const double> sent,
                                        std::span<const double> received, double tick_s)
{
    const auto in_samples = [&](double seconds) {
        return std::max<std::size_t>(1, ticks_in(seconds, tick_s));
    };
    const std::size_t count = std::min(sent.size(), received.size());
    if (count < in_samples(length_min_s)) return std::nullopt;
    const auto a = compressed(sent.first(count));
    const auto b = compressed(received.first(count));
    const auto is_zero = [](double value) { return value == 0.0; };
    if (std::ranges::all_of(a, is_zero) && std::ranges::all_of(b, is_zero)) return std::nullopt;

    const std::size_t coarse = in_samples(coarse_s);
    const std::size_t about = best_lag(a, b, {0, in_samples(lag_max_s), coarse}, coarse);
    const std::size_t lag =
        best_lag(a, b, {about > coarse ? about - coarse : 0, about + coarse, 1}, coarse);

    const std::size_t window = in_samples(window_s);
    double sum = 0.0;
    double windows = 0.0;
    for (std::size_t begin = 0; begin + window + lag <= count; begin += window) {
        Pairs pairs;
        for (std::size_t i = begin; i < begin + window; ++i) pairs.add(a[i], b[i + lag]);
        sum += structural_similarity(pairs);
        windows += 1.0;
    }
    if (windows == 0.0) return std::nullopt;
    return Similarity{.share = sum / windows, .lag_s = static_cast<double>(lag) * tick_s};
}

} // namespace hapnet::lab::metrics

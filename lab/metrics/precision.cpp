// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/precision.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::lab::metrics {

namespace {

double power(double x, double exponent)
{
    return x > 0.0 ? base::exp(exponent * base::log(x)) : 0.0;
}

/// Returns how unevenly the errors exceed those of an order: the variance of the logarithms of
/// their ratios.
double misfit(std::span<const StepError> errors, double reference, double order)
{
    double sum = 0.0, squares = 0.0;
    for (const StepError& one : errors) {
        const double due = std::abs(power(one.step, order) - power(reference, order));
        const double ratio = base::log(one.error) - base::log(due);
        sum += ratio;
        squares += ratio * ratio;
    }
    const auto count = static_cast<double>(errors.size());
    return squares / count - (sum / count) * (sum / count);
}

} // namespace

std::vector<double> mean_replicates(std::span<const double> by_seed, std::size_t draws)
{
    base::ensure(!by_seed.empty() && draws > 0);
    std::vector<double> means;
    for (const auto& weights : drawn_weights(by_seed.size(), draws)) {
        double sum = 0.0;
        for (std::size_t seed = 0; seed < weights.size(); ++seed)
            sum += weights[seed] * by_seed[seed];
        means.push_back(sum / static_cast<double>(draws));
    }
    return means;
}

double root_mean_square_error(std::span<const double> values, double truth)
{
    base::ensure(!values.empty());
    double squares = 0.0;
    for (const double value : values) squares += (value - truth) * (value - truth);
    return std::sqrt(squares / static_cast<double>(values.size()));
}

Interval paired_interval(std::span<const double> a, std::span<const double> b, std::uint32_t seeds)
{
    base::ensure(a.size() == b.size() && !a.empty());
    std::vector<double> apart;
    for (std::size_t i = 0; i < a.size(); ++i) apart.push_back(a[i] == b[i] ? 0.0 : a[i] - b[i]);
    return interval_of(std::move(apart), seeds);
}

std::optional<double> order_of(std::span<const StepError> errors, double reference)
{
    const auto differs = [&](const StepError& one) { return one.step != errors.front().step; };
    if (errors.size() < 2 || std::ranges::none_of(errors, differs)) return std::nullopt;
    constexpr double least = 0.1, most = 6.0, coarse = 0.1, fine = 1e-4;
    double best = least;
    for (double order = least; order <= most; order += coarse) {
        if (misfit(errors, reference, order) < misfit(errors, reference, best)) best = order;
    }
    for (double step = coarse / 2.0; step > fine; step /= 2.0) {
        for (const double order : {best - step, best + step}) {
            if (order < least || order > most) continue;
            if (misfit(errors, reference, order) < misfit(errors, reference, best)) best = order;
        }
    }
    const bool is_beyond = best < least + coarse / 2.0 || best > most - coarse / 2.0;
    return is_beyond ? std::nullopt : std::optional{best};
}

} // namespace hapnet::lab::metrics

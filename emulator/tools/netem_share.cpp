// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/netem.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace hapnet::emulator {

double netem_correlated_share(double share, double correlation)
{
    if (correlation <= 0.0 || share <= 0.0 || share >= 1.0) return std::clamp(share, 0.0, 1.0);
    constexpr std::size_t steps = 4096;
    constexpr double width = 1.0 / static_cast<double>(steps);
    const double rho = std::min(correlation, 0.999);
    // F(x) = P(X <= x) on a grid, and its integral; F goes over into the mean of F over the X'
    // that lead there, until it stays.
    std::vector<double> f(steps + 1);
    std::vector<double> sum(steps + 1);
    for (std::size_t i = 0; i <= steps; ++i) f[i] = static_cast<double>(i) * width;
    const auto integral = [&](double x) {
        if (x <= 0.0) return 0.0;
        if (x >= 1.0) return sum[steps] + (x - 1.0);
        const auto i = std::min(static_cast<std::size_t>(x / width), steps - 1);
        const double part = x / width - static_cast<double>(i);
        const double here = f[i] + (f[i + 1] - f[i]) * part;
        return sum[i] + 0.5 * (f[i] + here) * part * width;
    };
    constexpr int rounds_max = 3000;
    for (int round = 0; round < rounds_max; ++round) {
        sum[0] = 0.0;
        for (std::size_t i = 0; i < steps; ++i)
            sum[i + 1] = sum[i] + 0.5 * width * (f[i] + f[i + 1]);
        std::vector<double> next(steps + 1);
        double change = 0.0;
        for (std::size_t i = 0; i <= steps; ++i) {
            const double x = static_cast<double>(i) * width;
            const double all = integral(x / rho) - integral((x - (1.0 - rho)) / rho);
            next[i] = std::clamp(all * rho / (1.0 - rho), 0.0, 1.0);
            change = std::max(change, std::abs(next[i] - f[i]));
        }
        f = std::move(next);
        if (change < 1e-9) break;
    }
    const double place = share / width;
    const auto i = std::min(static_cast<std::size_t>(place), steps - 1);
    return f[i] + (f[i + 1] - f[i]) * (place - static_cast<double>(i));
}

} // namespace hapnet::emulator

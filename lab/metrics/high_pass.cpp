// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/high_pass.hpp"

#include "proto/base/math.hpp"

#include <cmath>

namespace hapnet::lab::metrics {

namespace {

constexpr double butterworth_2 = 0.70710678118654752440; // 1 / (2 sin(pi/4))
constexpr std::array butterworth_4{0.54119610014619698440, 1.30656296487637652786};

/// Returns tan(pi f T), which makes the bilinear transform exact at the frequency f.
double warped(const Cutoff& cutoff)
{
    const double angle = 0.5 * base::two_pi * cutoff.hertz * cutoff.tick_s;
    return base::sin(angle) / base::cos(angle);
}

double root_of_mean(double sum, double count) { return std::sqrt(sum / count); }

} // namespace

double Section::settle(double x)
{
    const double gain = (c_.b0 + c_.b1 + c_.b2) / (1.0 + c_.a1 + c_.a2);
    const double y = gain * x;
    second_ = c_.b2 * x - c_.a2 * y;
    first_ = c_.b1 * x - c_.a1 * y + second_;
    return y;
}

Section first_order_high_pass(const Cutoff& cutoff)
{
    const double k = warped(cutoff);
    const double scale = 1.0 / (1.0 + k);
    return Section{{.b0 = scale, .b1 = -scale, .a1 = (k - 1.0) * scale}};
}

Section second_order_high_pass(const Cutoff& cutoff, double quality)
{
    const double k = warped(cutoff);
    const double square = k * k;
    const double damping = k / quality;
    const double scale = 1.0 / (1.0 + damping + square);
    return Section{{.b0 = scale,
                    .b1 = -2.0 * scale,
                    .b2 = scale,
                    .a1 = 2.0 * (square - 1.0) * scale,
                    .a2 = (1.0 - damping + square) * scale}};
}

Section second_order_low_pass(const Cutoff& cutoff, double quality)
{
    const double k = warped(cutoff);
    const double square = k * k;
    const double damping = k / quality;
    const double scale = 1.0 / (1.0 + damping + square);
    return Section{{.b0 = square * scale,
                    .b1 = 2.0 * square * scale,
                    .b2 = square * scale,
                    .a1 = 2.0 * (square - 1.0) * scale,
                    .a2 = (1.0 - damping + square) * scale}};
}

std::optional<ByOrder> vibration_of(std::span<const double> signal,
                                    std::span<const std::uint8_t> counts, const Cutoff& cutoff)
{
    if (signal.empty()) return std::nullopt;
    Section first = first_order_high_pass(cutoff);
    Section second = second_order_high_pass(cutoff, butterworth_2);
    Section third = second_order_high_pass(cutoff, butterworth_4[0]);
    Section fourth = second_order_high_pass(cutoff, butterworth_4[1]);
    first.settle(signal.front());
    second.settle(signal.front());
    fourth.settle(third.settle(signal.front()));

    ByOrder sum;
    double count = 0.0;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        const double y1 = first.step(signal[i]);
        const double y2 = second.step(signal[i]);
        const double y4 = fourth.step(third.step(signal[i]));
        const double weight = counts.empty() ? 1.0 : counts[i];
        sum.first += weight * (y1 * y1);
        sum.second += weight * (y2 * y2);
        sum.fourth += weight * (y4 * y4);
        count += weight;
    }
    if (count == 0.0) return std::nullopt;
    return ByOrder{root_of_mean(sum.first, count), root_of_mean(sum.second, count),
                   root_of_mean(sum.fourth, count)};
}

std::optional<double> band_vibration_of(std::span<const double> signal, const Cutoff& from,
                                        const Cutoff& to)
{
    if (signal.empty()) return std::nullopt;
    Section high = second_order_high_pass(from, butterworth_2);
    Section low = second_order_low_pass(to, butterworth_2);
    low.settle(high.settle(signal.front()));
    double sum = 0.0;
    for (const double x : signal) {
        const double y = low.step(high.step(x));
        sum += y * y;
    }
    return root_of_mean(sum, static_cast<double>(signal.size()));
}

} // namespace hapnet::lab::metrics

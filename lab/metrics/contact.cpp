// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/contact.hpp"

#include "lab/metrics/ticks.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::lab::metrics {

namespace {

constexpr double lost_below_n = 0.02;
constexpr double slow_m_per_s = 0.08;
constexpr double fast_m_per_s = 0.12;
constexpr double speed_over_s = 0.020;
constexpr double drag_for_s = 0.1;

} // namespace

std::optional<double> force_discrepancy_of(const Columns& left, const Columns& right)
{
    double apart = 0.0;
    double sum = 0.0;
    const std::size_t count = std::min(left.push.size(), right.push.size());
    for (std::size_t i = 0; i < count; ++i) {
        if (left.touching[i] == 0 || right.touching[i] == 0) continue;
        apart += std::abs(left.push[i] - right.push[i]);
        sum += left.push[i] + right.push[i];
    }
    if (sum == 0.0) return std::nullopt;
    return apart / (0.5 * sum);
}

std::optional<double> contact_lost_of(std::span<const double> push)
{
    if (push.empty()) return std::nullopt;
    const auto lost =
        std::count_if(push.begin(), push.end(), [](double force) { return force < lost_below_n; });
    return static_cast<double>(lost) / static_cast<double>(push.size());
}

std::optional<double> drag_of(const Columns& side, double tick_s)
{
    const auto span = ticks_in(speed_over_s, tick_s);
    const double duration = static_cast<double>(span) * tick_s;
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = span; span > 0 && i < side.hip_x.size(); ++i) {
        const double speed = std::abs(side.hip_x[i] - side.hip_x[i - span]) / duration;
        if (speed < slow_m_per_s || speed > fast_m_per_s || side.touching[i] == 0) continue;
        sum += std::abs(side.hand_force[i]);
        count += 1.0;
    }
    if (count * tick_s < drag_for_s) return std::nullopt;
    return sum / count;
}

} // namespace hapnet::lab::metrics

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/causality.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::lab::metrics {

namespace {

constexpr double moves_m_per_s = 0.020;
constexpr double still_min_s = 0.050;
constexpr double apart_min_s = 0.100;
constexpr double wait_max_s = 0.6;

} // namespace

std::optional<double> response_of(const Columns& pusher, const Columns& other, double tick_s)
{
    const std::size_t count = std::min(pusher.touching.size(), other.body_x.size());
    const double moves_m = moves_m_per_s * tick_s;
    double sum_s = 0.0;
    double responses = 0.0;
    double still_s = 0.0; // time for which the other side's copy has not moved
    double apart_s = 0.0; // time for which the pusher has not touched
    bool waits = false;
    double waited_s = 0.0; // time since the touch that still has no response
    for (std::size_t i = 1; i < count; ++i) {
        const bool touches = pusher.touching[i] != 0;
        if (touches && !waits && apart_s >= apart_min_s && still_s >= still_min_s) {
            waits = true;
            waited_s = 0.0;
        }
        const bool moves = std::abs(other.body_x[i] - other.body_x[i - 1]) > moves_m;
        if (waits && moves) {
            sum_s += waited_s;
            responses += 1.0;
        }
        apart_s = touches ? 0.0 : apart_s + tick_s;
        still_s = moves ? 0.0 : still_s + tick_s;
        waited_s += tick_s;
        waits = waits && !moves && waited_s <= wait_max_s;
    }
    if (responses == 0.0) return std::nullopt;
    return sum_s / responses;
}

} // namespace hapnet::lab::metrics

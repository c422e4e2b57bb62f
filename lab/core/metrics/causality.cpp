// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/metrics/causality.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hapnet::lab {

namespace {

constexpr double moved_m = 0.1e-3;
constexpr double rest_m = 0.02e-3;
constexpr double rest_over_s = 0.010;
constexpr double wait_s = 1.0;

std::size_t samples_in(double seconds, double tick_s)
{
    return static_cast<std::size_t>(seconds / tick_s + 0.5);
}

/// Of the touches of one side.
struct Responses {
    double sum_s = 0.0;
    double count = 0.0;
};

Responses responses_to(const Columns& pusher, const Columns& other, double tick_s)
{
    const std::size_t count = std::min(pusher.body_x.size(), other.body_x.size());
    const std::size_t before = samples_in(rest_over_s, tick_s);
    const std::size_t wait = samples_in(wait_s, tick_s);
    const auto rests = [&](const Columns& side, std::size_t i) {
        return std::abs(side.body_x[i] - side.body_x[i - before]) < rest_m;
    };
    Responses responses;
    for (std::size_t i = before + 1; i < count; ++i) {
        const bool begins = pusher.touching[i] != 0 && pusher.touching[i - 1] == 0;
        if (!begins || other.touching[i] != 0) continue;
        if (!rests(pusher, i - 1) || !rests(other, i - 1)) continue;
        const std::size_t last = std::min(count - 1, i + wait);
        for (std::size_t j = i; j <= last; ++j) {
            if (std::abs(other.body_x[j] - other.body_x[i - 1]) < moved_m) continue;
            responses.sum_s += static_cast<double>(j - i) * tick_s;
            responses.count += 1.0;
            break;
        }
    }
    return responses;
}

} // namespace

std::optional<double> response_of(const Columns& left, const Columns& right, double tick_s)
{
    const Responses to_left = responses_to(left, right, tick_s);
    const Responses to_right = responses_to(right, left, tick_s);
    const double count = to_left.count + to_right.count;
    if (count == 0.0) return std::nullopt;
    return (to_left.sum_s + to_right.sum_s) / count;
}

} // namespace hapnet::lab

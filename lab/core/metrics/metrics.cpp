// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/metrics/metrics.hpp"

#include "lab/core/metrics/causality.hpp"
#include "lab/core/metrics/columns.hpp"
#include "lab/core/metrics/contact.hpp"
#include "lab/core/metrics/energy.hpp"
#include "lab/core/metrics/exercise.hpp"
#include "lab/core/metrics/presses.hpp"
#include "lab/core/metrics/stiffness.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace hapnet::lab {

namespace {

constexpr double vibration_above_hz = 20.0;
constexpr double felt_below_hz = 300.0;
constexpr double press_settles_s = 0.5; // a press is not yet steady then
constexpr double path_every_s = 0.010;

/// A trace as columns, and where its samples stand in time.
struct Taken {
    Exercise exercise;
    std::array<Columns, 2> sides;
    double tick_s = 0.001;
    double begin_s = 0.0;

    [[nodiscard]] std::size_t count() const { return sides[0].body_x.size(); }

    /// The first sample at or after a time.
    [[nodiscard]] std::size_t index_at(double seconds) const
    {
        const double index = std::ceil((seconds - begin_s) / tick_s - 1e-6);
        return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(count())));
    }
    [[nodiscard]] std::span<const double> cut(const std::vector<double>& column,
                                              const Stretch& stretch) const
    {
        const std::size_t begin = index_at(stretch.begin_s);
        const std::size_t end = std::max(begin, index_at(stretch.end_s));
        return std::span{column}.subspan(begin, end - begin);
    }
    /// No part of it is missing.
    [[nodiscard]] bool covers(const Stretch& stretch) const
    {
        const double end_s = begin_s + static_cast<double>(count()) * tick_s;
        return begin_s <= stretch.begin_s + 0.5 * tick_s && end_s >= stretch.end_s - 0.5 * tick_s;
    }
};

std::optional<Spread> body_discrepancy(const Taken& taken)
{
    std::vector<double> distances(taken.count());
    for (std::size_t i = 0; i < distances.size(); ++i) {
        distances[i] = std::abs(taken.sides[0].body_x[i] - taken.sides[1].body_x[i]);
    }
    return spread_of(distances);
}

std::optional<double> path_rms(const Taken& taken, const Columns& side)
{
    const auto stride = static_cast<std::size_t>(std::max(1.0, path_every_s / taken.tick_s));
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < side.body_x.size(); i += stride) {
        const double time = taken.begin_s + static_cast<double>(i) * taken.tick_s;
        const double apart = side.body_x[i] - device::path_x(taken.exercise.path_pace * time);
        sum += apart * apart;
        count += 1.0;
    }
    if (count == 0.0) return std::nullopt;
    return std::sqrt(sum / count);
}

void measure_side(const Taken& taken, std::size_t index, Metrics& metrics)
{
    const Columns& side = taken.sides[index];
    const Cutoff above{vibration_above_hz, taken.tick_s};
    const std::span<const std::uint8_t> follows{side.follows};
    metrics.body_vibration_m[index] = vibration_of(
        side.body_x, taken.exercise.by_turns ? follows : std::span<const std::uint8_t>{}, above);
    metrics.force_vibration_n[index] = vibration_of(side.hand_force, {}, above);
    metrics.felt_vibration_n[index] =
        band_vibration_of(side.hand_force, above, {felt_below_hz, taken.tick_s});
    metrics.contact_lost[index] = contact_lost_of(taken.cut(side.push, taken.exercise.contact));
    metrics.force_steps[index] = force_steps_of(side.hand_force, taken.tick_s);
    if (!taken.exercise.along_path) return;
    metrics.drag_n[index] = drag_of(side, taken.tick_s);
    metrics.path_rms_m[index] = path_rms(taken, side);
}

void measure_presses(const Taken& taken, std::span<const Press> presses, Metrics& metrics)
{
    for (const Press& press : presses) {
        const Stretch steady{press.begin_s + press_settles_s, press.end_s};
        if (!taken.covers(steady)) continue;
        const auto at = std::find(press_hertz.begin(), press_hertz.end(), press.hertz);
        if (at == press_hertz.end()) continue;
        const Columns& side = taken.sides[press.side];
        metrics.stiffness_n_per_m[static_cast<std::size_t>(at - press_hertz.begin())][press.side] =
            stiffness_of(taken.cut(side.hand_force, steady), taken.cut(side.hip_x, steady),
                         press.hertz, taken.tick_s);
    }
    if (presses.empty()) return;
    // The first hand's part of the task: from its first press to its last.
    Stretch first{presses[0].begin_s, presses[0].end_s};
    for (const Press& press : presses) {
        if (press.side == presses[0].side) first.end_s = press.end_s;
    }
    metrics.similarity =
        similarity_of(taken.cut(taken.sides[presses[0].side].hand_force, first),
                      taken.cut(taken.sides[1 - presses[0].side].hand_force, first), taken.tick_s);
}

} // namespace

Metrics metrics_of(const Trace& trace)
{
    const Taken taken{.exercise = exercise_of(trace.task),
                      .sides = {columns_of(trace.sides[0]), columns_of(trace.sides[1])},
                      .tick_s = base::to_seconds(trace.tick),
                      .begin_s = base::to_seconds(trace.begin)};
    Metrics metrics{.task = trace.task,
                    .scored_s = static_cast<double>(taken.count()) * taken.tick_s};
    if (taken.count() == 0) return metrics;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        measure_side(taken, side, metrics);
    }
    measure_presses(taken, presses_of(trace.task), metrics);
    const auto& [left, right] = taken.sides;
    metrics.force_discrepancy = force_discrepancy_of(left, right);
    metrics.discrepancy_m = body_discrepancy(taken);
    metrics.energy_taken_j = energy_taken_of(left.work, right.work);
    metrics.response_s = response_of(left, right, taken.tick_s);
    return metrics;
}

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/metrics.hpp"

#include "device/simulated/press_schedule.hpp"
#include "lab/metrics/causality.hpp"
#include "lab/metrics/columns.hpp"
#include "lab/metrics/contact.hpp"
#include "lab/metrics/energy.hpp"
#include "lab/metrics/exercise.hpp"
#include "lab/metrics/stiffness.hpp"
#include "lab/metrics/worse.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace hapnet::lab::metrics {

namespace {

constexpr double vibration_above_hz = 20.0;
constexpr double tugging_above_hz = 2.0;
constexpr double felt_below_hz = 300.0;
// A peer that learns late of the session's start must catch up first. Only the discrepancy includes
// the effect of that.
constexpr double catching_up_s = 0.5;
constexpr double path_every_s = 0.010;
constexpr double fallen_m = 0.025; // half the height to which the body is lifted

/// A trace as columns, with the times of its samples.
struct TraceColumns {
    Exercise exercise;
    std::vector<Columns> sides;
    double tick_s = 0.001;
    double begin_s = 0.0;

    [[nodiscard]] std::size_t count() const { return sides[0].body_x.size(); }

    /// Returns the first sample at or after a time.
    [[nodiscard]] std::size_t index_at(double seconds) const
    {
        const double index = std::ceil((seconds - begin_s) / tick_s - 1e-6);
        return static_cast<std::size_t>(std::clamp(index, 0.0, static_cast<double>(count())));
    }
    /// Returns the first sample at which all peers have caught up.
    [[nodiscard]] std::size_t steady() const { return index_at(begin_s + catching_up_s); }
    [[nodiscard]] std::span<const double> cut(const std::vector<double>& column,
                                              const Stretch& stretch) const
    {
        const std::size_t begin = index_at(stretch.begin_s);
        const std::size_t end = std::max(begin, index_at(stretch.end_s));
        return std::span{column}.subspan(begin, end - begin);
    }
    /// True if the trace contains the whole stretch.
    [[nodiscard]] bool covers(const Stretch& stretch) const
    {
        const double end_s = begin_s + static_cast<double>(count()) * tick_s;
        return begin_s <= stretch.begin_s + 0.5 * tick_s && end_s >= stretch.end_s - 0.5 * tick_s;
    }
};

std::optional<double> path_rms(const TraceColumns& columns, const Columns& side)
{
    const auto stride = static_cast<std::size_t>(std::max(1.0, path_every_s / columns.tick_s));
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = columns.steady(); i < side.body_x.size(); i += stride) {
        const double time = columns.begin_s + static_cast<double>(i) * columns.tick_s;
        const double apart = side.body_x[i] - device::path_x(columns.exercise.path_pace * time);
        sum += apart * apart;
        count += 1.0;
    }
    if (count == 0.0) return std::nullopt;
    return std::sqrt(sum / count);
}

std::optional<double> contact_lost(const TraceColumns& columns, const Columns& side)
{
    std::vector<double> push;
    for (const Stretch& stretch : columns.exercise.contact) {
        const auto part = columns.cut(side.push, stretch);
        push.insert(push.end(), part.begin(), part.end());
    }
    return contact_lost_of(push);
}

void measure_side(const TraceColumns& columns, std::size_t index, Metrics& metrics)
{
    const Columns& side = columns.sides[index];
    const std::size_t role = index % 2; // 0: acts as A; 1: acts as B
    const auto note = [role]<typename Value>(BySide<Value>& of_roles,
                                             const std::optional<Value>& value) {
        of_roles[role] = worse(of_roles[role], value);
    };
    const Cutoff above{vibration_above_hz, columns.tick_s};
    const auto body_x = std::span{side.body_x}.subspan(columns.steady());
    const auto force = std::span{side.hand_force}.subspan(columns.steady());
    const auto follows = std::span{side.follows}.subspan(columns.steady());
    note(metrics.body_vibration_m,
         vibration_of(body_x, columns.exercise.by_turns ? follows : std::span<const std::uint8_t>{},
                      above));
    note(metrics.force_vibration_n, vibration_of(force, {}, above));
    note(metrics.force_above_2hz_n, vibration_of(force, {}, {tugging_above_hz, columns.tick_s}));
    note(metrics.felt_vibration_n,
         band_vibration_of(force, above, {felt_below_hz, columns.tick_s}));
    note(metrics.contact_lost, contact_lost(columns, side));
    note(metrics.force_steps, force_steps_of(force, columns.tick_s));
    if (const auto stop = columns.exercise.stopped_at_m) {
        double farthest = *stop;
        for (const double x : body_x) farthest = std::max(farthest, x);
        note(metrics.overshoot_m, std::optional{farthest - *stop});
    }
    if (!columns.exercise.along_path) return;
    note(metrics.drag_n, drag_of(side, columns.tick_s));
    note(metrics.path_rms_m, path_rms(columns, side));
}

void measure_presses(const TraceColumns& columns, Metrics& metrics)
{
    for (const device::PressInterval& press : device::press_schedule) {
        const Stretch steady{press.begin_s + 1.0 / press.hertz, press.end_s};
        const auto at = std::find(press_hertz.begin(), press_hertz.end(), press.hertz);
        if (!columns.covers(steady) || at == press_hertz.end()) continue;
        const std::size_t presser = press.left_presses ? 0 : 1;
        const Columns& side = columns.sides[presser];
        const auto felt =
            stiffness_of(columns.cut(side.hand_force, steady), columns.cut(side.hip_x, steady),
                         press.hertz, columns.tick_s);
        if (!felt) continue;
        const auto index = static_cast<std::size_t>(at - press_hertz.begin());
        metrics.stiffness_n_per_m[index][presser] = felt->storage_n_per_m;
        metrics.loss_stiffness_n_per_m[index][presser] = felt->loss_n_per_m;
    }
    Stretch left{device::press_schedule[0].begin_s, device::press_schedule[0].end_s};
    for (const device::PressInterval& press : device::press_schedule) {
        if (press.left_presses) left.end_s = press.end_s;
    }
    metrics.similarity =
        similarity_of(columns.cut(columns.sides[0].hand_force, left),
                      columns.cut(columns.sides[1].hand_force, left), columns.tick_s);
}

std::optional<double> drops(const TraceColumns& columns)
{
    double count = 0.0;
    for (const Stretch& stretch : columns.exercise.lifted) {
        if (!columns.covers(stretch)) return std::nullopt;
        const auto falls = [&](const Columns& side) {
            const auto heights = columns.cut(side.body_y, stretch);
            return std::any_of(heights.begin(), heights.end(),
                               [](double height) { return height < fallen_m; });
        };
        if (std::ranges::any_of(columns.sides, falls)) count += 1.0;
    }
    return count;
}

} // namespace

Metrics metrics_of(const virtual_time::Trace& trace)
{
    base::ensure(trace.sides.size() >= 2);
    TraceColumns columns{.exercise = exercise_of(trace.task),
                         .sides = {},
                         .tick_s = base::to_seconds(trace.tick),
                         .begin_s = base::to_seconds(trace.begin)};
    for (const auto& side : trace.sides) {
        base::ensure(side.size() == trace.sides.front().size());
        columns.sides.push_back(columns_of(side));
    }
    Metrics metrics{.task = trace.task,
                    .scored_s = static_cast<double>(columns.count()) * columns.tick_s};
    if (columns.count() == 0) return metrics;
    std::vector<std::span<const double>> work;
    for (std::size_t side = 0; side < columns.sides.size(); ++side) {
        measure_side(columns, side, metrics);
        work.emplace_back(columns.sides[side].work);
    }
    if (columns.exercise.presses) measure_presses(columns, metrics);
    if (!columns.exercise.lifted.empty()) metrics.drops = drops(columns);
    const Columns &left = columns.sides[0], &right = columns.sides[1];
    if (columns.exercise.presses) metrics.force_discrepancy = force_discrepancy_of(left, right);
    metrics.bodies = bodies_apart(trace);
    metrics.discrepancy_m = widest_discrepancy_x(metrics.bodies);
    metrics.turned_apart_rad = widest_turned_apart(metrics.bodies);
    metrics.energy_taken_j = energy_taken_of(work);
    if (trace.rate_bit_per_s > 0.0) metrics.rate_bit_per_s = trace.rate_bit_per_s;
    if (columns.exercise.taps) metrics.response_s = response_of(left, right, columns.tick_s);
    return metrics;
}

} // namespace hapnet::lab::metrics

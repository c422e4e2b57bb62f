// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/bodies.hpp"
#include "lab/metrics/high_pass.hpp"
#include "lab/metrics/similarity.hpp"
#include "lab/metrics/spread.hpp"
#include "lab/metrics/steps.hpp"
#include "lab/virtual_time/trace.hpp"
#include "proto/base/describe.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace hapnet::lab::metrics {

/// Values of A and of B. With more than two hands, the larger value of the hands that act as A, and
/// of those that act as B.
template <typename Value>
using BySide = std::array<std::optional<Value>, 2>;

/// The frequencies at which stiffness is measured.
inline constexpr std::array press_hertz{0.5, 1.0, 2.0};
/// The index of the frequency whose stiffness_ratio is reported.
inline constexpr std::size_t judged_press = 1;
/// The index of the slowest of the frequencies.
inline constexpr std::size_t slow_press = 0;

/// The measured metrics of a session, A to L. SI units. A metric that the task does not exercise is
/// nullopt. scores_of() relates metrics to the unimpaired session where that is needed.
/// docs/design/metrics.md explains what each one can show and what it cannot.
struct Metrics {
    device::Task task = device::Task::p1;
    double scored_s = 0.0; // how long all sides were running

    /// A: root mean square of the body's x above 20 Hz, metres. In a task by turns it counts only
    /// while the side follows.
    BySide<ByOrder> body_vibration_m{};
    /// B: dynamic stiffness by the frequency of pressing (press_hertz) and the pressing side, N/m:
    /// its storage and its loss.
    std::array<BySide<double>, press_hertz.size()> stiffness_n_per_m{};
    std::array<BySide<double>, press_hertz.size()> loss_stiffness_n_per_m{};
    /// C: mean ||F_L| - |F_R|| over the mean force, at equal times, for the first two hands.
    std::optional<double> force_discrepancy{};
    /// D: |x_L - x_R| of the body at equal times, metres. With more than two copies, or several
    /// bodies, it is that of the two copies that are farthest apart in the mean.
    std::optional<Spread> discrepancy_m{};
    /// D of a body that turns: the angle between its orientations in two copies at equal times,
    /// radians, for the two copies that are farthest apart in the mean. nullopt when no body turns.
    std::optional<Spread> turned_apart_rad{};
    /// D of each shared body, in the order of their ids.
    std::vector<BodyApart> bodies{};
    /// E: root mean square of the force on the hand in x above 20 Hz, newtons.
    BySide<ByOrder> force_vibration_n{};
    /// E2: the same above 2 Hz, where two copies pull at each other slowly.
    BySide<ByOrder> force_above_2hz_n{};
    /// E between 20 and 300 Hz. It is not weighted by the transmission of a stylus: no table of
    /// that was available.
    BySide<double> felt_vibration_n{};
    /// F: the share of the time of commanded contact, 0 to 1, in which the contact force is less
    /// than 0.02 N.
    BySide<double> contact_lost{};
    /// G: of the force on the hand in x.
    BySide<ForceSteps> force_steps{};
    /// H: the greatest energy that the hands together got out of their devices, joules.
    std::optional<double> energy_taken_j{};
    /// I: mean force on the hand at a speed of about 0.1 m/s, newtons.
    BySide<double> drag_n{};
    /// J: root mean square of the distance, in x, of a side's body from the path it is to follow.
    BySide<double> path_rms_m{};
    /// J: the number of lifts in which a side's body falls below half of the height to which it is
    /// lifted, while it is to be held up.
    std::optional<double> drops{};
    /// J: the distance of a side's body beyond the point where the static cube stops it, metres.
    BySide<double> overshoot_m{};
    /// K: the time from a tap of A to the motion of B's body, seconds.
    std::optional<double> response_s{};
    /// L: the similarity of the force on the resting hand to the force on the pressing hand.
    std::optional<Similarity> similarity{};
    /// The traffic of the busiest direction between any two sides, with the headers of UDP over
    /// IPv4, bit/s.
    std::optional<double> rate_bit_per_s{};

    friend bool operator==(const Metrics&, const Metrics&) = default;
};
/// A value by side is a list of two, null where there is no value.
constexpr auto fields_of(base::Tag<Metrics>)
{
    using M = Metrics;
    return base::fields(
        "metrics", base::member("task", &M::task, "The task that was played."),
        base::member("scored_s", &M::scored_s, "How long all sides were running."),
        base::member("body_vibration_m", &M::body_vibration_m,
                     "A: root mean square of the body's x above 20 Hz, by the order of the filter, "
                     "for each side."),
        base::member("stiffness_n_per_m", &M::stiffness_n_per_m,
                     "B: stiffness in phase with the deflection, by the frequency of pressing, "
                     "for each side."),
        base::member("loss_stiffness_n_per_m", &M::loss_stiffness_n_per_m,
                     "B: stiffness a quarter of a period ahead, likewise."),
        base::member("force_discrepancy", &M::force_discrepancy,
                     "C: mean ||F_L| - |F_R|| over the mean force."),
        base::member("discrepancy_m", &M::discrepancy_m,
                     "D: |x_L - x_R| of the body at equal times."),
        base::member("turned_apart_rad", &M::turned_apart_rad,
                     "D of a body that turns: the angle between its orientations."),
        base::member("bodies", &M::bodies, "D of each shared body."),
        base::member("force_vibration_n", &M::force_vibration_n,
                     "E: root mean square of the force on the hand in x above 20 Hz."),
        base::member("force_above_2hz_n", &M::force_above_2hz_n, "E2: the same above 2 Hz."),
        base::member("felt_vibration_n", &M::felt_vibration_n, "E between 20 and 300 Hz."),
        base::member("contact_lost", &M::contact_lost,
                     "F: share of the time of commanded contact without 0.02 N of it."),
        base::member("force_steps", &M::force_steps, "G: of the force on the hand in x."),
        base::member("energy_taken_j", &M::energy_taken_j,
                     "H: the most energy that the hands got out of their devices."),
        base::member("drag_n", &M::drag_n, "I: mean force at a speed of about 0.1 m/s."),
        base::member("path_rms_m", &M::path_rms_m,
                     "J: root mean square of the distance from the path to follow."),
        base::member("drops", &M::drops, "J: lifts in which a body is down by half."),
        base::member("overshoot_m", &M::overshoot_m,
                     "J: how far a body was beyond where the static cube stops it."),
        base::member("response_s", &M::response_s, "K: from a tap of A to the motion of B's body."),
        base::member("similarity", &M::similarity,
                     "L: of what the resting hand feels to what the pressing hand does."),
        base::member("rate_bit_per_s", &M::rate_bit_per_s,
                     "Traffic of the busiest direction between any two, with the headers of UDP "
                     "over IPv4."));
}

[[nodiscard]] Metrics metrics_of(const virtual_time::Trace& trace);

} // namespace hapnet::lab::metrics

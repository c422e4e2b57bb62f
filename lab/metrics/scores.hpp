// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/metrics.hpp"

#include <array>
#include <optional>

namespace hapnet::lab::metrics {

/// Metrics relative to those of the same session (task, algorithm, hands, seed) on a perfect
/// network: the effect of the network. Stiffness is relative to that of the same hands in one
/// shared world. SI units; the values of the worse side.
struct Scores {
    device::Task task = device::Task::p1;
    /// The time in which all sides were running, as a share of that on the perfect network.
    double scored_share = 0.0;

    /// A: sqrt(a^2 - a0^2), where a is the vibration and a0 that on the perfect network; 0 when a
    /// is below a0.
    std::optional<ByOrder> vibration_m{};
    /// B: the magnitude of the mean dynamic stiffness of both hands, over that in one shared world,
    /// by press_hertz.
    std::array<std::optional<double>, press_hertz.size()> stiffness_ratio{};
    /// B: the largest of |B - B0| / |B0| over press_hertz, where B is the mean dynamic stiffness of
    /// both hands and B0 that in one shared world. 0: the right stiffness; 1: nothing is felt.
    std::optional<double> stiffness_error{};
    /// B: the same at the slowest press only.
    std::optional<double> slow_stiffness_error{};
    /// C as measured, and the part of it that the perfect network does not show.
    std::optional<double> force_discrepancy{};
    std::optional<double> force_discrepancy_added{};
    /// D as measured.
    std::optional<Spread> discrepancy_m{};
    std::optional<Spread> turned_apart_rad{};
    /// E as measured (e), and sqrt(e^2 - e0^2), where e0 is that on the perfect network; 0 when e
    /// is below e0.
    std::optional<ByOrder> force_vibration_n{};
    std::optional<ByOrder> force_vibration_added_n{};
    /// E2: sqrt(e^2 - e0^2), where e is the vibration above 2 Hz and e0 that on the perfect
    /// network; 0 when e is below e0.
    std::optional<ByOrder> force_above_2hz_added_n{};
    std::optional<double> felt_vibration_n{};
    /// F: the share lost beyond that on the perfect network; below 0 when less is lost.
    std::optional<double> contact_lost{};
    /// G as measured.
    std::optional<ForceSteps> force_steps{};
    /// H as measured.
    std::optional<double> energy_taken_j{};
    /// I: mean force beyond that on the perfect network; below 0 when it is less.
    std::optional<double> drag_n{};
    /// J: the root mean square distance from the path, over that on the perfect network.
    std::optional<double> path_rms_m{};
    std::optional<double> path_rms_ratio{};
    std::optional<double> drops{};
    std::optional<double> overshoot_m{};
    /// K: the response time beyond that on the perfect network. It is the delay if all is well.
    std::optional<double> response_added_s{};
    /// L as measured.
    std::optional<Similarity> similarity{};
    /// The rate as measured.
    std::optional<double> rate_bit_per_s{};

    friend bool operator==(const Scores&, const Scores&) = default;
};

/// Returns the reference for sessions: the metrics on a perfect network, with the stiffness that
/// the hands feel in one shared world.
[[nodiscard]] Metrics make_reference(Metrics perfect, const Metrics& one_world);

/// Computes the scores. Both metrics must be of the same task; see make_reference().
[[nodiscard]] Scores scores_of(const Metrics& impaired, const Metrics& reference);

} // namespace hapnet::lab::metrics

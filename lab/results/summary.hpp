// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/paired.hpp"
#include "lab/metrics/verdict.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hapnet::lab::results {

/// The results of all seeds together. Means and intervals are over the seeds; with recorded people
/// they are over the subjects, each with the mean of its sessions.
struct Summary {
    std::optional<metrics::Spread> typical_m{}; // the means of the discrepancy's figures
    std::optional<metrics::Interval> mean_m{};  // 95 % of the mean of the mean
    std::optional<double> discrepancy_max_m{};  // the largest of any seed
    std::optional<double> force_step_n{};       // as well
    std::optional<double> turned_apart_max_rad{};
    metrics::Scores worst{};                  // in every respect as bad as that of the worst seed
    metrics::Tier tier = metrics::Tier::good; // of the worst
    std::size_t usable = 0;                   // seeds that are at least usable
    std::string limited_by{};                 // what keeps it from the next tier
};

/// A task's scores by session; at least one. `subjects` has the subject of each; empty: they have
/// none.
[[nodiscard]] Summary summarize(std::span<const metrics::Scores> scores,
                                const metrics::Criteria& criteria,
                                std::span<const std::string> subjects = {});

/// The figures by which a session is judged.
struct Judged {
    std::optional<double> mean_mm{};
    std::optional<double> vibration_mm{};
    std::optional<double> stiffness_ratio{};
    std::optional<double> force_vibration_n{};
    metrics::Tier tier{};
    std::optional<double> turned_apart_deg{}; // mean of the worst seed; where a body turns
    std::optional<double> stiffness_error{};
    std::optional<double> slow_stiffness_error{};
};
/// The columns of its members, in their order, except stiffness errors.
inline constexpr std::string_view judged_columns =
    "mean_mm:3,vibration_mm:3,stiffness_ratio:4,force_vibration_n:4,tier,turned_apart_deg:3?";
/// The columns of stiffness errors. They come after the columns of the parties.
inline constexpr std::string_view stiffness_error_columns =
    "stiffness_error:4?,slow_stiffness_error:4?";

/// Returns the figures that are judged: the worst ones, by the filter that the criteria use. The
/// mean is the typical one.
[[nodiscard]] Judged make_judged(const Summary& summary, const metrics::Criteria& criteria);

} // namespace hapnet::lab::results

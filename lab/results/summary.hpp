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

/// The results of all seeds together. Means and intervals are over the seeds. With recorded people
/// they are over the subjects, each with the mean of its sessions.
struct Summary {
    /// The figures of the discrepancy, each as its mean over the seeds.
    std::optional<metrics::Spread> typical_m{};
    /// The 95 % interval of the mean in `typical_m`.
    std::optional<metrics::Interval> mean_m{};
    std::optional<double> discrepancy_max_m{}; // largest discrepancy of any seed
    std::optional<double> force_step_n{};      // largest force step of any seed
    std::optional<double> turned_apart_max_rad{};
    metrics::Scores worst{};                  // each score as bad as that of the worst seed
    metrics::Tier tier = metrics::Tier::good; // tier of `worst`
    std::size_t usable = 0;                   // number of sessions that are at least usable
    std::string limited_by{};                 // reasons why `worst` is not in the next tier
};

/// Summarizes a task's scores by session; there is at least one. `subjects` has the subject of
/// each; empty: they have none.
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
    std::optional<double> turned_apart_deg{}; // mean angle of the worst seed, if a body turns
    std::optional<double> stiffness_error{};
    std::optional<double> slow_stiffness_error{};
};
/// The columns of the members of Judged, in their order, except stiffness errors.
inline constexpr std::string_view judged_columns =
    "mean_mm:3,vibration_mm:3,stiffness_ratio:4,force_vibration_n:4,tier,turned_apart_deg:3?";
/// The columns of stiffness errors. They come after the columns of the parties.
inline constexpr std::string_view stiffness_error_columns =
    "stiffness_error:4?,slow_stiffness_error:4?";

/// Returns the figures that are judged: the worst ones, by the filter of the criteria. The mean is
/// the typical one.
[[nodiscard]] Judged make_judged(const Summary& summary, const metrics::Criteria& criteria);

} // namespace hapnet::lab::results

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/core/metrics/verdict.hpp"

#include <optional>
#include <span>
#include <string>

namespace hapnet::lab {

/// What the sessions of all seeds say together: the discrepancy's mean, min and std are means over
/// the seeds, and so is the max in `typical`; everything else is that of the worst seed.
struct Summary {
    std::optional<Spread> typical_m{};
    std::optional<double> discrepancy_max_m{};
    std::optional<double> vibration_m{};
    std::optional<double> stiffness_ratio{};
    std::optional<double> force_vibration_n{};
    std::optional<double> force_discrepancy{};
    std::optional<double> contact_lost{};
    std::optional<double> force_step_n{};
    std::optional<double> drag_n{};
    std::optional<double> energy_j{};
    Tier tier = Tier::good;
    std::string limited_by{}; // what keeps the worst seed from the next tier
};

/// A task's scores by seed, in their order; at least one.
[[nodiscard]] Summary summary_of(std::span<const Scores> scores, const Criteria& criteria);

} // namespace hapnet::lab

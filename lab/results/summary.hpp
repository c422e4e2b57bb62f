// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/verdict.hpp"
#include "lab/results/rows.hpp"

#include <optional>
#include <span>
#include <string>

namespace hapnet::lab::results {

/// What the sessions of all seeds say together.
struct Summary {
    std::optional<metrics::Spread>
        typical_m{}; // the means over the seeds of the discrepancy's figures
    std::optional<double> discrepancy_max_m{}; // the largest of any seed
    std::optional<double> force_step_n{};      // as well
    std::optional<double> turned_apart_max_rad{};
    metrics::Scores worst{};                  // in every respect as bad as that of the worst seed
    metrics::Tier tier = metrics::Tier::good; // of the worst
    std::string limited_by{};                 // what keeps it from the next tier
};

/// A task's scores by seed; at least one.
[[nodiscard]] Summary summarize(std::span<const metrics::Scores> scores,
                                const metrics::Criteria& criteria);

/// What is judged of the worst, by the filter that the criteria judge by; the mean is the typical.
[[nodiscard]] Judged make_judged(const Summary& summary, const metrics::Criteria& criteria);

} // namespace hapnet::lab::results

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/criteria.hpp"
#include "lab/metrics/scores.hpp"

namespace hapnet::lab::metrics {

/// The scores of a press exactly as on the perfect network.
[[nodiscard]] inline Scores perfect()
{
    Scores scores{.task = device::Task::t2, .scored_share = 1.0};
    scores.vibration_m = ByOrder{};
    scores.stiffness_ratio = {1.0, 1.0, 1.0};
    scores.stiffness_error = 0.0;
    scores.slow_stiffness_error = 0.0;
    scores.force_discrepancy = 0.04;
    scores.force_vibration_added_n = ByOrder{};
    scores.contact_lost = 0.0;
    scores.drag_n = 0.0;
    return scores;
}

/// Limits that some tests tighten.
[[nodiscard]] inline Criteria criteria()
{
    Criteria criteria;
    criteria.usable.vibration_max_m = {.first = 1.0e-3, .second = 0.9e-3, .fourth = 0.8e-3};
    criteria.usable.slow_stiffness_error_max = 0.9;
    return criteria;
}

} // namespace hapnet::lab::metrics

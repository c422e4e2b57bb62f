// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/criteria.hpp"
#include "lab/results/precision_table.hpp"
#include "lab/results/table.hpp"

#include <span>

namespace hapnet::lab::results {

/// Returns the table rankings. It shows whether the order of the algorithms depends on the hands,
/// for an axis over hands some of which are recorded people's. It has a row for each value, task
/// and algorithm of kind Table1. `mean_mm` is the mean over the seeds or subjects, and `rank` the
/// rank by it (1 is the nearest copies). Kendall's tau-b compares this order with that of the first
/// value: the pairs of algorithms in the same order less the pairs in the opposite order, over the
/// pairs that are not tied. `ci_low` and `ci_high` are its 95 % interval by resampling the seeds or
/// subjects of this value. `subjects` is 0 for simulated hands.
[[nodiscard]] Table ranking_table(const experiment::Axis& axis,
                                  std::span<const AxisFindings> values,
                                  const metrics::Criteria& criteria);

} // namespace hapnet::lab::results

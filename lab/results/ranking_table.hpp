// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/criteria.hpp"
#include "lab/results/precision_table.hpp"
#include "lab/results/table.hpp"

#include <span>

namespace hapnet::lab::results {

/// Whether the order of the algorithms depends on the hands: the table rankings, of an axis over
/// hands some of which are recorded people's. A row for each value, task and algorithm of kind
/// Table1: `mean_mm` over the seeds or subjects, `rank` by it (1 is the nearest copies), and
/// Kendall's tau between this order and that of the first value: the share of pairs of algorithms
/// in the same order less that of pairs in the other (Kendall 1938; a tie counts for neither).
/// `subjects` is 0 of simulated hands. `ci_low` and `ci_high`: its 95 % interval by resampling the
/// seeds or subjects of this value.
[[nodiscard]] Table ranking_table(const experiment::Axis& axis,
                                  std::span<const AxisFindings> values,
                                  const metrics::Criteria& criteria);

} // namespace hapnet::lab::results

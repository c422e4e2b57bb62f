// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/criteria.hpp"
#include "lab/results/precision_table.hpp"
#include "lab/results/table.hpp"

#include <span>

namespace hapnet::lab::results {

/// The table rankings says whether the order of the algorithms depends on the hands, for an axis
/// over hands some of which are recorded people's. A row for each value, task and algorithm of kind
/// Table1: `mean_mm` over the seeds or subjects, `rank` by it (1 is the nearest copies), and
/// Kendall's tau-b between this order and that of the first value: the pairs of algorithms in the
/// same order less the pairs in the other, over those that are told apart. `subjects` is 0 of
/// simulated hands. `ci_low` and `ci_high`: its 95 % interval by resampling the seeds or subjects
/// of this value.
[[nodiscard]] Table ranking_table(const experiment::Axis& axis,
                                  std::span<const AxisFindings> values,
                                  const metrics::Criteria& criteria);

} // namespace hapnet::lab::results

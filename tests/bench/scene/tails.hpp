// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/compare.hpp"

namespace hapnet::bench {

/// Returns the time of each step of a course, ns: the least over several runs, and the lesser of
/// the wall clock's and the thread's time. The runs are equal, and pauses of the machine hit
/// different steps, so the algorithm's own time is left. The contenders take turns run by run.
/// Empty for an engine that cannot run it.
[[nodiscard]] std::vector<std::vector<double>>
least_times(const Course& course, std::span<const Contender> contenders, int runs);

/// Returns the value below which a share of the times lies: 0.5 the median, 1 the greatest.
[[nodiscard]] double quantile(std::vector<double> values, double share);

/// Returns rows for the p50, the p99 and the worst step of a course. The question's target applies
/// to the worst step.
[[nodiscard]] std::vector<Row> tails_of(const Course& course, std::span<const Entry> entries,
                                        const Question& question, int runs);

} // namespace hapnet::bench

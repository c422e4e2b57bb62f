// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/compare.hpp"

namespace hapnet::bench {

/// How long each step of a course took, ns: of several runs from its start the least, step by
/// step, and of the wall's clock and the thread's the lesser. The runs are equal, so what is left
/// is the algorithm's: the machine's pauses hit other steps in every run. The contenders take turns
/// run by run. Empty for one that cannot run it.
[[nodiscard]] std::vector<std::vector<double>>
least_times(const Course& course, std::span<const Contender> contenders, int runs);

/// The value below which a share of them lies: 0.5 the median, 1 the greatest.
[[nodiscard]] double quantile(std::vector<double> values, double share);

/// Rows for the p50, the p99 and the worst step of a course. The question has the target of the
/// worst, if any.
[[nodiscard]] std::vector<Row> tails_of(const Course& course, std::span<const Entry> entries,
                                        const Question& question, int runs);

} // namespace hapnet::bench

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/file.hpp"
#include "lab/results/results.hpp"

#include <vector>

namespace hapnet::lab::report {

/// The figures for a paper: gnuplot/NAME.gp and the .dat that it reads, for each of table1, fig6a,
/// fig6b and fig7 that there are results of. `gnuplot NAME.gp` in that folder writes NAME.pdf,
/// `gnuplot -e "format='svg'" NAME.gp` NAME.svg.
[[nodiscard]] std::vector<File> gnuplot_files(const Results& results);

} // namespace hapnet::lab::report

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"

#include <vector>

namespace hapnet::bench {

/// Measures how many times faster than real time sessions run on one processor. Returns a row for
/// each task and algorithm: the median over `rounds`, in which the cases take turns.
[[nodiscard]] std::vector<Row> measure_speed(int rounds);

} // namespace hapnet::bench

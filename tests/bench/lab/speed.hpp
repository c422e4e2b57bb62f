// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"

#include <vector>

namespace hapnet::bench {

/// How many times faster than life sessions are played on one processor, a row for each task and
/// algorithm: the median over `rounds` in which the cases take turns.
[[nodiscard]] std::vector<Row> measure_speed(int rounds);

} // namespace hapnet::bench

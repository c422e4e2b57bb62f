// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/subjects.hpp"

#include <vector>

namespace hapnet::bench {

/// The lateness of eco, precise and the timerfd relay while a process on each processor never
/// sleeps: 60 s of each at each rate, in short turns; a few seconds when the plan is quick.
[[nodiscard]] std::vector<Row> measure_beside_busy(const Plan& plan, bool fifo);

} // namespace hapnet::bench

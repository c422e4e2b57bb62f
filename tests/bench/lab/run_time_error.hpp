// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hapnet::bench {

/// One figure of Table 1, as found with a certain amount of work, and its true value.
struct WorkPoint {
    std::string_view varied; // "tick", "steps" of the hands in a tick, "seeds"
    std::string task;
    std::string algorithm;
    std::string_view figure; // "mean", "std", "max"
    double tick_ms = 1.0;
    int steps = 0; // 0: one exact step
    int seeds = 1;
    double wall_s = 0.0;
    double error_mm = 0.0; // with several seeds: the root mean square over groups of that number
    double reference_mm = 0.0;

    [[nodiscard]] double error_percent() const { return 100.0 * error_mm / reference_mm; }
};

/// - P1, ticks of 4 to 0.25 ms, and hands that go through a tick of 1 ms in 1 to 100 steps: against
///   a tick of 50 us with exact hands. P1 has no randomness, so one seed is enough.
/// - T3, 1 to 20 seeds: against the mean of 200 (1 to 10 and 60 when quick).
[[nodiscard]] std::vector<WorkPoint> measure_run_time_error(bool quick);

[[nodiscard]] std::string work_csv(const std::vector<WorkPoint>& points);
/// Returns the error of an ordinary run: a tick of 1 ms and exact hands; ten seeds of T3.
[[nodiscard]] std::vector<Row> work_rows(const std::vector<WorkPoint>& points);

} // namespace hapnet::bench

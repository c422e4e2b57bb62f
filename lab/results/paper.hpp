// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/level.hpp"
#include "lab/metrics/spread.hpp"

#include <optional>
#include <string_view>

namespace hapnet::lab {

// What the paper says, and what counts as agreeing with it. Algorithms go by their names.

/// Table 1: |x_L - x_R| at 160 ms, in mm.
struct PaperRow {
    double mean_mm = 0.0;
    double std_mm = 0.0;
    double max_mm = 0.0;
};

/// nullopt: the paper has no such algorithm.
[[nodiscard]] std::optional<PaperRow> paper_table1(std::string_view algorithm);

/// The number in the paper's Fig. 6, in the impairment's unit.
[[nodiscard]] std::optional<double> paper_limit(std::string_view algorithm, Impairment impairment);

/// "met", "missed" or "calibrated"; empty: the paper has no such algorithm. `mm` is what was
/// measured of the algorithm, `base_mm` of base, in mm; the paper's row of base was calibrated on.
/// - base: calibrated when mean, std and max are within 10 % of the paper's;
/// - dead-reckoning: met when mean and std are within 15 % of the paper's and max is 40 to 65 mm;
/// - sep: met when mean, std and max are within 3 % of base's.
[[nodiscard]] std::string_view table1_verdict(std::string_view algorithm, const Spread& mm,
                                              const std::optional<Spread>& base_mm);

/// A limit as it was found, in the impairment's unit.
struct FoundLimit {
    double limit = 0.0;
    bool ever_failed = true;
};

/// "calibrated", "predicted-met" or "predicted-missed"; empty: the paper has no such algorithm.
/// `base` is the limit of base in the same task, without which what is relative to it is missed.
/// - base: delay and random loss are calibrated when they come out within 5 % and 1 of the paper's
///   number, burst loss is met within 5 of 100, jitter from 15 ms;
/// - sep: jitter from 15 ms; delay and random loss when within 5 % and 1 of base's; burst loss when
///   it is no less than base's;
/// - dead-reckoning: delay from 130 to 155 ms and less than base's; random loss from 60 to 85 % and
///   less than base's; burst loss when it is more than base's; jitter from 3 to 6 ms.
/// A limit never reached within its range meets no band that ends above.
[[nodiscard]] std::string_view limit_status(std::string_view algorithm, Impairment impairment,
                                            const FoundLimit& found,
                                            const std::optional<FoundLimit>& base);

} // namespace hapnet::lab

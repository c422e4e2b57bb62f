// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/impairment.hpp"
#include "lab/metrics/spread.hpp"
#include "lab/results/rows.hpp"

#include <limits>
#include <optional>
#include <string_view>

namespace hapnet::lab::results {

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
[[nodiscard]] std::optional<double> paper_limit(std::string_view algorithm,
                                                experiment::Impairment impairment);

/// From low to high, ends included.
struct Band {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool holds(double value) const { return value >= low && value <= high; }
};

/// Where the numbers of Table 1 agree:
/// - base: mean, std and max within 10 % of the paper's;
/// - dead-reckoning: mean and std within 15 % of the paper's, max from 40 to 65 mm;
/// - sep: mean, std and max within 3 % of base's, which was measured in the same run.
struct Table1Bands {
    Band mean_mm{};
    Band std_mm{};
    Band max_mm{};
};

/// nullopt when there is nothing to hold the algorithm against.
[[nodiscard]] std::optional<Table1Bands>
table1_bands(std::string_view algorithm, const std::optional<metrics::Spread>& base_mm);

/// Claim::none: the paper has no such algorithm. `mm` is what was measured of the algorithm,
/// `base_mm` of base. The paper's row of base was calibrated on.
[[nodiscard]] Claim table1_verdict(std::string_view algorithm, const metrics::Spread& mm,
                                   const std::optional<metrics::Spread>& base_mm);

/// A limit as it was found, in the impairment's unit.
struct FoundLimit {
    double limit = 0.0;
    bool ever_failed = true;
};

/// Where a limit agrees, for people to read: "130 to 155, less than base"; empty for what the paper
/// does not know.
[[nodiscard]] std::string_view limit_band(std::string_view algorithm, std::string_view impairment);

/// LimitStatus::none: the paper has no such algorithm. `base` is the limit of base in the same
/// task, without which what is relative to it is missed. Delay and random loss of base were
/// calibrated on. A limit never reached within its range meets no band that ends above.
[[nodiscard]] LimitStatus limit_status(std::string_view algorithm,
                                       experiment::Impairment impairment, const FoundLimit& found,
                                       const std::optional<FoundLimit>& base);

} // namespace hapnet::lab::results

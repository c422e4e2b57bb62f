// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/impairment.hpp"
#include "lab/metrics/psychometric.hpp"
#include "lab/metrics/spread.hpp"
#include "lab/results/verdicts.hpp"

#include <limits>
#include <optional>
#include <string_view>

namespace hapnet::lab::results {

// The paper's results, and the ranges that count as agreement with them. Algorithms are identified
// by their names.

/// Table 1: |x_L - x_R| at 160 ms, in mm.
struct PaperRow {
    double mean_mm = 0.0;
    double std_mm = 0.0;
    double max_mm = 0.0;
};

/// Returns nullopt when the paper has no such algorithm.
[[nodiscard]] std::optional<PaperRow> paper_table1(std::string_view algorithm);

/// Returns the number in the paper's Fig. 6, in the impairment's unit; nullopt: the paper states
/// none. For jitter it states only that of dead reckoning; at the 15 ms of its Fig. 7 base and
/// TiDeC were still usable.
[[nodiscard]] std::optional<double> paper_limit(std::string_view algorithm,
                                                experiment::Impairment impairment);

/// Returns the origin of a limit, of one task or of the worst task (worst_task). The thresholds
/// were calibrated on base's delay, which shows in T2, and on its random loss, which shows in T1.
/// Readings of the paper were chosen with a look at dead reckoning's jitter and random loss and at
/// base's bursts, in T1. In T1 one hand pushes at a time, so sep is base by construction; so are
/// its limits, except that of delay. Provenance::none: the paper has no such algorithm.
[[nodiscard]] Provenance limit_provenance(std::string_view algorithm,
                                          experiment::Impairment impairment, std::string_view task);

/// The provenance of a row of Table 1: of its mean and standard deviation, and of its maximum. P1's
/// path was fitted to base's row. Its frequencies were also chosen with a look at the ratio of dead
/// reckoning's mean to base's.
struct Table1Provenance {
    Provenance typical{};
    Provenance max{};
};
[[nodiscard]] Table1Provenance table1_provenance(std::string_view algorithm);

/// A range from low to high, ends included.
struct Band {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool holds(double value) const { return value >= low && value <= high; }
};

/// The ranges in which the numbers of Table 1 agree:
/// - base: mean, std and max within 10 % of the paper's;
/// - dead-reckoning: mean and std within 15 % of the paper's, max from 40 to 65 mm;
/// - sep: mean, std and max within 3 % of base's, which was measured in the same run.
struct Table1Bands {
    Band mean_mm{};
    Band std_mm{};
    Band max_mm{};
};

/// Returns nullopt when there is nothing to compare the algorithm with.
[[nodiscard]] std::optional<Table1Bands>
table1_bands(std::string_view algorithm, const std::optional<metrics::Spread>& base_mm);

/// Returns the verdict on a row of Table 1; Claim::none: the paper has no such algorithm. `mm` was
/// measured with the algorithm, `base_mm` with base. The paper's row of base was used for
/// calibration.
[[nodiscard]] Claim table1_verdict(std::string_view algorithm, const metrics::Spread& mm,
                                   const std::optional<metrics::Spread>& base_mm);

/// Returns the range in which a limit agrees, for people: "130 to 155, less than base"; empty where
/// the paper makes no claim.
[[nodiscard]] std::string_view limit_band(std::string_view algorithm, std::string_view impairment);

/// Compares the limit of the worst task with the paper's. `base` is base's limit. The 95 %
/// intervals decide. Met: the interval of p50 is within the band, and that of the paired difference
/// from base is where it should be. Missed: one of them is outside. Otherwise undecided.
/// LimitStatus::none: the paper states no number, or base is needed and was not played.
[[nodiscard]] LimitStatus limit_status(std::string_view algorithm,
                                       experiment::Impairment impairment,
                                       const metrics::Threshold& found,
                                       const metrics::Threshold* base);

} // namespace hapnet::lab::results

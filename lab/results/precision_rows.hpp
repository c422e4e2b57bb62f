// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/metrics/criteria.hpp"
#include "lab/results/rows.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::results {

/// Of precision.csv: what a figure by so many seeds, at one value of a parameter, is off from the
/// same figure by all seeds at the reference, and what it costs.
struct PrecisionRow {
    std::string algorithm;
    std::string task;
    std::string figure; // with its unit: "mean_mm", a mean over the seeds; "p50 of delay, ms"
    std::string parameter;
    std::string value;
    std::string reference;
    std::uint32_t seeds = 0;
    /// Of all players, in the whole length of the sessions behind the figure, those on perfect
    /// networks included.
    std::uint64_t ticks = 0;
    double found = 0.0; // the figure by all seeds
    /// By all seeds, from the reference, with the 95 % interval of resampling them in pairs; the
    /// interval is nullopt of one seed.
    double difference = 0.0;
    std::optional<double> ci_low{};
    std::optional<double> ci_high{};
    /// The root mean square over draws of so many seeds; nullopt: some of them find no limit.
    std::optional<double> error{};
};
constexpr auto fields_of(base::Tag<PrecisionRow>)
{
    using Row = PrecisionRow;
    constexpr base::Decimals six{6};
    return base::fields(
        "precision", base::field("algorithm", &Row::algorithm), base::field("task", &Row::task),
        base::field("figure", &Row::figure), base::field("parameter", &Row::parameter),
        base::field("value", &Row::value), base::field("reference", &Row::reference),
        base::field("seeds", &Row::seeds), base::field("ticks", &Row::ticks),
        base::field("found", &Row::found, six), base::field("difference", &Row::difference, six),
        base::field("ci_low", &Row::ci_low, six), base::field("ci_high", &Row::ci_high, six),
        base::field("error", &Row::error, six));
}

/// What came of all jobs of an experiment at one value of its axis.
struct AxisFindings {
    std::string value;
    const experiment::Experiment* experiment = nullptr;
    std::vector<experiment::JobResult> results;
};

/// Of every figure that all seeds have at the reference: at each value, by 1, 2, 5, 10, ... and all
/// seeds. The axis has a reference, which is among the values.
[[nodiscard]] std::vector<PrecisionRow> make_precision_rows(const experiment::Axis& axis,
                                                            std::span<const AxisFindings> values,
                                                            const metrics::Criteria& criteria);

} // namespace hapnet::lab::results

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/metrics/criteria.hpp"
#include "lab/results/table.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::results {

/// The results of all jobs of an experiment at one value of its axis.
struct AxisFindings {
    std::string value;
    const experiment::Experiment* experiment = nullptr;
    std::vector<experiment::JobResult> results;
};

/// Returns the table precision: the error and the cost of figures with fewer seeds and at other
/// values of a parameter. They are compared with the same figures with all seeds at the reference.
/// The table has every figure that all seeds give at the reference, at each value, with 1, 2, 5,
/// 10, ... and all seeds. The axis has a reference, which is among its values.
///
/// `figure` includes its unit: "mean_mm", a mean over the seeds; "p50 of delay, ms". `ticks` counts
/// those of all players, in the whole length of the sessions behind the figure, including the
/// sessions on perfect networks. `found` is the figure with all seeds. `difference` is that of
/// `found` from the reference's figure, with the 95 % interval of resampling the seeds in pairs.
/// `error` is the root mean square over draws of this number of seeds, empty where some draws find
/// no limit. `order` is the order in which the figure converges.
[[nodiscard]] Table precision_table(const experiment::Axis& axis,
                                    std::span<const AxisFindings> values,
                                    const metrics::Criteria& criteria);

} // namespace hapnet::lab::results

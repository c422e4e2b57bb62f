// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/metrics/psychometric.hpp"
#include "lab/results/verdicts.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::results {

/// The limit of one task, or of the worst task, for one tier.
struct TaskLimit {
    const experiment::NamedAlgorithm* algorithm = nullptr;
    experiment::Impairment impairment{};
    std::string_view task; // name of the task, or worst_task
    experiment::Party party{};
    metrics::Tier tier = metrics::Tier::usable;
    metrics::Threshold threshold{};
    /// True if half of the sessions fail at level 0. Then the threshold is meaningless.
    bool fails_at_rest = false;
    /// The metric by which most of the sessions fail at the first counted level from p50 on; empty
    /// where less than half fail at the top of the range.
    std::string_view decided_by{};
    /// The number of bits that the busiest direction carries for each message, IP and UDP headers
    /// included, as measured in the sessions; nullopt: the interval was not searched.
    std::optional<double> message_bits{};
};

/// Returns the limits of an experiment of kind Limits by algorithm, impairment, party and tier:
/// those of each task, and after them those of the worst task. `results` are those of all its jobs.
[[nodiscard]] std::vector<TaskLimit> task_limits(const experiment::Experiment& experiment,
                                                 const metrics::Criteria& criteria,
                                                 std::span<const experiment::JobResult> results);

/// Returns the name of a figure: "p50 of delay, ms"; for a tier other than usable "p50 of delay,
/// ms, good".
[[nodiscard]] std::string p50_of(experiment::Impairment impairment, metrics::Tier tier);

/// Returns the tier of a row; nullopt in an experiment whose only tier is usable.
[[nodiscard]] std::optional<metrics::Tier> tier_cell(const experiment::Experiment& experiment,
                                                     metrics::Tier tier);

} // namespace hapnet::lab::results

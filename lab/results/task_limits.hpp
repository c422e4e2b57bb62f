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

/// The limit of one task, or of the worst of them, for one tier.
struct TaskLimit {
    const experiment::NamedAlgorithm* algorithm = nullptr;
    experiment::Impairment impairment{};
    std::string_view task; // name of the task, or worst_task
    experiment::Party party{};
    metrics::Tier tier = metrics::Tier::usable;
    metrics::Threshold threshold{};
    /// Half of the sessions fail at level 0: the threshold says nothing.
    bool fails_at_rest = false;
    /// The metric that most of the sessions fail by at the first level that counts from p50 on;
    /// empty where less than half fails at the top of the range.
    std::string_view decided_by{};
    /// The bits that the busiest direction carries for each message, IP and UDP headers included,
    /// as the sessions measured it; nullopt: the interval was not searched.
    std::optional<double> message_bits{};
};

/// The limits of an experiment of kind Limits by algorithm, impairment, party and tier: of each
/// task, and after them of the worst. `results` are those of all its jobs.
[[nodiscard]] std::vector<TaskLimit> task_limits(const experiment::Experiment& experiment,
                                                 const metrics::Criteria& criteria,
                                                 std::span<const experiment::JobResult> results);

/// "p50 of delay, ms"; of a tier other than usable "p50 of delay, ms, good".
[[nodiscard]] std::string p50_of(experiment::Impairment impairment, metrics::Tier tier);

/// The tier of a row; nullopt in an experiment whose only tier is usable.
[[nodiscard]] std::optional<metrics::Tier> tier_cell(const experiment::Experiment& experiment,
                                                     metrics::Tier tier);

} // namespace hapnet::lab::results

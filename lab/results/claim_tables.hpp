// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/claims.hpp"
#include "lab/metrics/scores.hpp"
#include "lab/results/table.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::results {

/// A session under a claim's conditions, and its outcome.
struct ClaimSession {
    const experiment::ClaimCell* cell = nullptr;
    std::string algorithm;
    device::Task task{};
    std::uint32_t seed = 0;
    metrics::Scores scores{};
};

struct ClaimSessions {
    std::vector<ClaimSession> sessions; // in the order of the jobs
    std::vector<double> silence_m;      // distances of copies after silence, first algorithm
};

[[nodiscard]] ClaimSessions claim_sessions_of(const experiment::Experiment& experiment,
                                              std::span<const experiment::JobResult> results);

/// Returns the claims of the first of the algorithms: two tables with a row for each claim, and one
/// with a row for each of their numbers. In `claims`, `value` has the claim's numbers of the worst
/// judging seed, or of the seeds' mean where the claim says so; `accept` has the limits that they
/// must keep. `verdict` is met when all numbers of the judging seeds keep their limits, and
/// undecided when one was not measured. In `claims_quantiles`, `quantile` is the value that 9 of 10
/// of all seeds keep, or the mean. In `claims_numbers`, `value` is the mean, and `low` and `high`
/// are its 95 % interval; or, as `judged_by` says, they are the worst, the least and the greatest
/// of the sessions. `kept` is empty where no session has the number.
[[nodiscard]] std::vector<Table> claim_tables(const experiment::Experiment& experiment,
                                              const metrics::Criteria& criteria,
                                              const ClaimSessions& sessions);

/// Returns the table sessions. Vibrations and forces are those that the network adds.
/// `scored_share` is a share of the time in which both sides would run on a perfect network.
[[nodiscard]] Table claim_sessions_table(const metrics::Criteria& criteria,
                                         const ClaimSessions& sessions);

} // namespace hapnet::lab::results

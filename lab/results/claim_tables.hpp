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

/// A session of a claim's conditions, and its outcome.
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

/// The claims of the first of the algorithms, in two tables of a row for each, and one of a row for
/// each of their numbers. Of `claims`: `value`
/// has the claim's numbers of the worst seed that judges, or of their mean where the claim says so;
/// `accept` what they have to keep. `verdict` is met when all are, for the seeds that judge, and
/// undecided when one was not measured. Of `claims_quantiles`: `quantile` is what 9 of 10 of all
/// seeds keep, or the mean. Of `claims_numbers`: `value` is the mean, `low` and `high` its 95 %
/// interval; or, as `judged_by` says, the worst of the sessions, their least and their most. `kept`
/// is empty where no session has the number.
[[nodiscard]] std::vector<Table> claim_tables(const experiment::Experiment& experiment,
                                              const metrics::Criteria& criteria,
                                              const ClaimSessions& sessions);

/// The table sessions. Vibrations and forces are what the network adds; `scored_share` is of the
/// time that both would run on a perfect network.
[[nodiscard]] Table claim_sessions_table(const metrics::Criteria& criteria,
                                         const ClaimSessions& sessions);

} // namespace hapnet::lab::results

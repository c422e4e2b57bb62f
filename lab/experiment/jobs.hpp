// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/search.hpp"
#include "lab/experiment/session_spec.hpp"
#include "lab/metrics/psychometric.hpp"
#include "lab/metrics/verdict.hpp"

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace hapnet::lab::experiment {

// An experiment divided into jobs that do not depend on one another. Each job gives the same result
// on any thread and in any order.

/// One session and the reference for its scores.
struct SessionJob {
    std::size_t algorithm = 0; // index in Experiment::algorithms
    device::Task task{};
    SessionSpec spec{};
    Party party{};
    std::size_t trial = 0; // index of the trial of the people whose hands play
};

/// The search for one limit.
struct SearchJob {
    std::size_t algorithm = 0;
    device::Task task{};
    SearchRange range{};
    Party party{};
};

/// The search for one limit with these hands, once for each order of the filter.
struct SensitivityJob {
    std::size_t algorithm = 0;
    device::Task task{};
    SearchRange range{};
    Party party{};
    Hands hands{};
};

/// Measures the distance of copies after silence: see claims.hpp.
struct SilenceJob {
    std::size_t algorithm = 0;
    SessionSpec spec{};
};

using Job = std::variant<SessionJob, SearchJob, SensitivityJob, SilenceJob>;

/// The jobs of an experiment in the order of its results.
[[nodiscard]] std::vector<Job> make_jobs(const Experiment& experiment);

struct SessionResult {
    metrics::Metrics metrics{};
    metrics::Metrics reference{}; // see metrics::make_reference()
    std::string rows{};
};

/// A session that a search played.
struct CurvePoint {
    ImpairmentLevel level{};
    std::uint32_t seed = 1;
    bool counts = false; // true if its level counts for a tier, not only for a coarse scan
    metrics::Scores scores{};
    metrics::Tier tier{};
};

/// The result of a search: for each tier of the experiment, in order, the outcomes of the levels
/// that count (levels in the impairment's unit, ascending); and all sessions.
struct SearchResult {
    std::vector<std::vector<metrics::LevelOutcome>> outcomes{};
    std::vector<CurvePoint> curve{}; // ascending in level, then seed
};

/// The outcomes for each filter order of the sensitivity check, in the order of the filter orders.
struct SensitivityResult {
    std::vector<std::vector<metrics::LevelOutcome>> outcomes{};
};

struct SilenceResult {
    double apart_m = 0.0;
};

using JobResult = std::variant<SessionResult, SearchResult, SensitivityResult, SilenceResult>;

/// Runs one job, with `play` for its sessions. Returns the error of `play` if it fails.
[[nodiscard]] base::Result<JobResult> run_job(const Job& job, const Experiment& experiment,
                                              const metrics::Criteria& criteria,
                                              const PlaySession& play);

} // namespace hapnet::lab::experiment

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"

#include <cstddef>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::results {

/// The circumstances of a run. Its results do not depend on them.
struct Circumstances {
    std::string command; // command line
    std::string start;   // start time, ISO 8601, UTC
    double wall_time_s = 0.0;
    nlohmann::ordered_json host{};
    std::string program{}; // "hapnet-lab 1.2.3 (commit abc, GCC 12.2.0)"; empty: several programs
    /// The processor time of all threads; nullopt: other programs took part in the run.
    std::optional<double> processor_time_s{};
};

/// Returns a time in ISO 8601, UTC, whole seconds.
[[nodiscard]] std::string utc_text(double since_1970_s);

/// Returns the beginning of every manifest.json: command, version, commit, compiler, host, time.
[[nodiscard]] nlohmann::ordered_json manifest_head(const Circumstances& circumstances);

/// The outcome of the run of an experiment.
struct RunOutcome {
    std::string criteria;   // criteria as TOML
    std::size_t played = 0; // sessions played in this run
    std::size_t reused = 0;
    std::vector<std::string> invalid_because{};
    std::string digest{}; // digest of all results; empty: there are none
    /// The recorded people whose hands played, if any did at any value of an axis.
    std::shared_ptr<const hands::Population> people{};
};

/// Returns the manifest.json of an experiment's folder of results.
[[nodiscard]] nlohmann::ordered_json make_manifest(const experiment::Experiment& experiment,
                                                   const Circumstances& circumstances,
                                                   const RunOutcome& outcome);

} // namespace hapnet::lab::results

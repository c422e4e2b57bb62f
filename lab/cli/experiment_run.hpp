// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/shard.hpp"
#include "lab/experiment/text.hpp"
#include "lab/metrics/criteria.hpp"
#include "lab/runner/session_store.hpp"
#include "proto/base/result.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace hapnet::lab {

/// An experiment: the whole as it is stated, and the parts that are played one after the other.
struct LoadedExperiment {
    struct Part {
        std::size_t point = 0;           // number of the point of the axes that it plays
        experiment::AxisValues values{}; // values of the axes at that point; empty: no axes
        experiment::Experiment experiment;
    };

    experiment::Experiment whole;
    std::vector<Part> parts;
    metrics::Criteria criteria;
    std::string program; // identity of the program that plays
    std::size_t jobs = 0;
};

/// The folder of the results, and the manifest's data about their origin.
struct RunPlace {
    std::string out;
    unsigned threads = 1;
    std::string command; // command line, for the manifest
};

/// Plays the sessions that are missing, and writes the results. Returns the exit code, or an error
/// when it cannot begin.
[[nodiscard]] base::Result<int> run_whole(const LoadedExperiment& experiment,
                                          const RunPlace& place);

/// Plays the sessions of a shard into shards/I-of-N.jsonl. Writes I-of-N.done when all are played.
[[nodiscard]] base::Result<int> run_shard(const LoadedExperiment& experiment,
                                          const experiment::Shard& shard, const RunPlace& place);

/// Writes the results from the sessions that the shards in these folders have played. The results
/// go to the first folder. Returns exit code 1, with the reason on standard error, if sessions are
/// missing.
[[nodiscard]] base::Result<int> merge_shards(const LoadedExperiment& experiment,
                                             const std::vector<std::string>& folders,
                                             const RunPlace& place);

} // namespace hapnet::lab

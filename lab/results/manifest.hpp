// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::lab {

/// What happened around a run, which its results do not follow from.
struct Circumstances {
    std::string command;  // what was typed
    std::string criteria; // TOML
    std::string program;  // "hapnet-lab 0.1.0 (commit abc, GCC 12.2.0)"
    nlohmann::ordered_json host;
    double start_s = 0.0; // since 1970
    double wall_time_s = 0.0;
    std::size_t played = 0; // sessions
    std::size_t reused = 0;
    std::vector<std::string> invalid_because;
};

/// manifest.json of a folder of results.
[[nodiscard]] nlohmann::ordered_json manifest_of(const Experiment& experiment,
                                                 const Circumstances& circumstances);

} // namespace hapnet::lab

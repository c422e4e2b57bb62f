// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::web {

/// The statistics that a program of a run wrote at its end.
struct ProgramStatistics {
    std::string name; // name for people: "A", "the emulator"
    std::string text; // contents of its file; empty: it wrote none
};

/// The verdict on a run of the stage: valid, or the reasons why it is not.
struct RunVerdict {
    int run = 0;
    std::vector<std::string> because; // why the run is not valid; empty: it is valid

    /// Returns {"run":3,"valid":true,"invalid_because":[]}.
    [[nodiscard]] nlohmann::ordered_json json() const;
    /// Returns "run 3 has ended: valid", or the reasons why it is not.
    [[nodiscard]] std::string text() const;
};

/// Returns the verdict that follows from the statistics of all programs.
[[nodiscard]] RunVerdict verdict_of(int run, const std::vector<ProgramStatistics>& programs);

} // namespace hapnet::web

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/paths.hpp"
#include "emulator/options.hpp"
#include "emulator/recorder.hpp"
#include "emulator/scenario.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// The files that a run records and the setup of its paths, for any kind of port. The options and
/// the scenario must outlive it.
struct Plan {
    const Options& options;
    const Scenario& scenario;
    Recorder::Files files;
    std::vector<Paths::Setup> parts; // one for each thread
};

/// Returns the plan of a run with this number of paths, which share the memory. Each thread has its
/// part of the memory. The fates have the names of their paths if there may be several paths.
[[nodiscard]] Plan plan_of(const Options& options, const Scenario& scenario, std::size_t paths,
                           base::TimePoint start);

/// Returns the names of the interfaces in the capture of the path between two ends: "1 (to 2)", "2
/// (to 1)".
[[nodiscard]] CaptureNames capture_names(const std::string& first, const std::string& second);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/all_paths.hpp"
#include "emulator/direction_report.hpp"
#include "emulator/options.hpp"
#include "emulator/ports/links.hpp"
#include "emulator/recorder.hpp"
#include "emulator/scenario.hpp"
#include "proto/base/time.hpp"
#include "proto/net/real_time.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// All that a report on a run is made from, whatever moves its datagrams.
struct AnyRun {
    const Options& options;
    const Scenario& scenario;
    AllPaths paths;
    const Recorder& recorder;
    net::RealTime real_time{};
    base::Duration elapsed{}; // since the sockets were bound
    bool is_over = false;     // nothing waits for the statistics any more: they may be long
    /// What a run cannot do without and has lost, such as an interface: a sentence each. With one
    /// of them the run is not valid.
    std::vector<std::string> failures{};
};

/// With what moves them. `has_names`: its paths have them.
template <typename PortType, bool has_names>
struct RunOf : AnyRun {
    using Port = PortType;

    const Port& port;
};

/// Of one pair.
using Run = RunOf<ports::Links, false>;

/// What is known of the direction that begins on this side.
[[nodiscard]] DirectionOfRun direction_of(const ports::Relay::Side& side);

/// The line that says that the emulator listens: "ready a=127.0.0.1:7001 b=... seed=42 ...".
[[nodiscard]] std::string ready_line(const Run& run);

// The parts of statistics that runs of all kinds have.

/// What they begin with: the program, and how it ran.
[[nodiscard]] nlohmann::ordered_json head_of(const AnyRun& run);

/// What of each direction differs from the default, as a profile says it.
[[nodiscard]] nlohmann::ordered_json configuration_json(const Path& path);

/// What held on the path called `name` at the start and in the end, and how it changed. While the
/// run goes on, only the last changes.
void add_course(nlohmann::ordered_json& json, const AnyRun& run, const EmulatedPath& path,
                std::string_view name);

/// The profile and the files of the run.
void add_files(nlohmann::ordered_json& json, const AnyRun& run);

/// A direction of one path. A run that keeps each fate keeps whole distributions, too.
[[nodiscard]] nlohmann::ordered_json json_of_way(DirectionOfRun direction, const AnyRun& run);

/// What has become of the checks, if there are any: after all that they may speak of.
void add_checks(nlohmann::ordered_json& json, const AnyRun& run);

/// What is missing in the files that were asked for, a line each.
[[nodiscard]] std::string incomplete(const Recorder& recorder);

/// What the run has lost for good or for a time, a line each.
[[nodiscard]] std::string failures_in_words(const AnyRun& run);

/// What --stats writes: one JSON object.
[[nodiscard]] nlohmann::ordered_json statistics_of(const Run& run);

/// A few lines for a person.
[[nodiscard]] std::string summary(const Run& run);

/// One short line for a terminal.
[[nodiscard]] std::string status_line(const Run& run);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/run_statistics.hpp"
#include "emulator/core/all_paths.hpp"
#include "emulator/core/direction_report.hpp"
#include "emulator/options.hpp"
#include "emulator/ports/links.hpp"
#include "emulator/recorder.hpp"
#include "emulator/scenario.hpp"
#include "proto/base/time.hpp"
#include "proto/net/real_time.hpp"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

struct PathState;
struct RunState;
struct WayState;

/// A run with any kind of port. Reports are made from it and from a RunState. Values that change
/// during the run are read only from the RunState.
struct AnyRun {
    const Options& options;
    const Scenario& scenario;
    AllPaths paths;
    const Recorder& recorder;
    net::RealTime real_time{};
    base::Duration elapsed{}; // time since the sockets were bound
    /// Failures of things that the run needs, such as a lost interface: a sentence each. A run with
    /// a failure is not valid.
    std::vector<std::string> failures{};
};

/// A run with the ports that move its datagrams. `has_names`: its paths have names.
template <typename PortType, bool has_names>
struct RunOf : AnyRun {
    using Port = PortType;

    const Port& port;
};

/// A run of one pair.
using Run = RunOf<ports::Links, false>;

/// Returns the line that reports that the emulator listens: "ready a=127.0.0.1:7001 b=... seed=42
/// ...".
[[nodiscard]] std::string ready_line(const Run& run);

// The parts of statistics that runs of all kinds have.

/// Returns the beginning of all statistics: the program, its mode of operation, the profile and the
/// files of the run.
[[nodiscard]] RunStatistics statistics_of_any(const AnyRun& run, const RunState& state);

/// Returns the settings of each direction that differ from the default, as a profile writes them.
[[nodiscard]] Configuration configuration_of(const Path& path);

/// Returns the conditions of the path at the start and at the end, and its changes. During the run,
/// it has only the latest changes.
[[nodiscard]] CourseReport course_of(const AnyRun& run, const PathState& path);

/// Returns the report on a direction of one path. It refers to `way`. If the run records each fate,
/// the report has whole distributions once the run is over.
[[nodiscard]] DirectionReport report_of(const WayState& way, const AnyRun& run,
                                        const RunState& state);

/// Returns the report on a direction of a path. It refers to `path`. With flows, it is the sum of
/// the flows and the other traffic.
[[nodiscard]] DirectionReport report_of(const PathState& path, Direction direction,
                                        const AnyRun& run, const RunState& state);

/// Returns the reports on the flows of a path. They refer to `path`. nullopt: the run has no flows.
[[nodiscard]] std::optional<FlowReports> flows_of(const PathState& path, const AnyRun& run,
                                                  const RunState& state);

/// Adds the reasons why flows are not valid: "flow.voice.up: ...".
void add_reasons(std::vector<std::string>& reasons, const std::optional<FlowReports>& flows);

/// Adds the reasons why a direction is not valid: "up: ...".
void add_reasons(std::vector<std::string>& reasons, std::string_view way,
                 const DirectionReport& report);

/// Sets the verdict of a run. It is valid when there are no `reasons` against it and its files are
/// complete.
void judge(RunStatistics& statistics, const AnyRun& run, std::vector<std::string> reasons);

/// Adds the report on the path of a run that has only one.
void tell_of_path(RunStatistics& statistics, const AnyRun& run, const RunState& state);

/// Returns the statistics as JSON, with the outcomes of the checks, if there are any.
[[nodiscard]] nlohmann::ordered_json json_of(RunStatistics& statistics, const AnyRun& run);

// The parts of a summary that runs of all kinds have.

/// Returns a line for each direction of a run that has one path.
[[nodiscard]] std::string words_of_path(const AnyRun& run, const RunState& state);
/// Returns a line for each kind of missing entries in the files that were asked for, and for each
/// thing that the run has lost for good or for a time.
[[nodiscard]] std::string closing_words(const AnyRun& run, const RunState& state);

/// Returns the statistics that --stats writes: one JSON object.
[[nodiscard]] nlohmann::ordered_json statistics_of(const Run& run, const RunState& state);

/// Returns a few lines for a person.
[[nodiscard]] std::string summary(const Run& run, const RunState& state);

/// Returns one short line for a terminal.
[[nodiscard]] std::string status_line(const Run& run, const RunState& state);

} // namespace hapnet::emulator

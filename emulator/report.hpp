// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/paths.hpp"
#include "emulator/direction_report.hpp"
#include "emulator/options.hpp"
#include "emulator/ports/links.hpp"
#include "emulator/recorder.hpp"
#include "emulator/scenario.hpp"
#include "proto/base/time.hpp"
#include "proto/net/real_time.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hapnet::emulator {

/// All that a report on a run is made from. `has_names`: its paths have them.
template <typename PortType, bool has_names>
struct RunOf {
    using Port = PortType;

    const Options& options;
    const Scenario& scenario;
    const Paths& paths;
    const Port& port;
    const Recorder& recorder;
    net::RealTime real_time;
    base::Duration elapsed{}; // since the sockets were bound
};

/// Of one pair.
using Run = RunOf<ports::Links, false>;

/// What is known of the direction that begins on this side.
[[nodiscard]] DirectionOfRun direction_of(const ports::Relay::Side& side);

/// The line that says that the emulator listens: "ready a=127.0.0.1:7001 b=... seed=42 ...".
[[nodiscard]] std::string ready_line(const Run& run);

/// What of each direction differs from the default, as a profile says it.
[[nodiscard]] nlohmann::ordered_json configuration_json(const Path& path);

/// What is missing in the files that were asked for, a line each.
[[nodiscard]] std::string incomplete(const Recorder& recorder);

/// What --stats writes: one JSON object.
[[nodiscard]] std::string statistics_json(const Run& run);

/// A few lines for a person.
[[nodiscard]] std::string summary(const Run& run);

/// One short line for a terminal.
[[nodiscard]] std::string status_line(const Run& run);

} // namespace hapnet::emulator

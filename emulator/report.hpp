// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/emulated_path.hpp"
#include "emulator/endpoints.hpp"
#include "emulator/options.hpp"
#include "emulator/ports/relay.hpp"
#include "emulator/scenario.hpp"
#include "proto/base/time.hpp"
#include "proto/net/real_time.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hapnet::emulator {

/// All that a report is made from.
struct Run {
    const Options& options;
    const Scenario& scenario;
    const EmulatedPath& path;
    const ports::Relay& relay;
    const Recorder& recorder;
    net::RealTime real_time;
    base::Duration elapsed{}; // since the sockets were bound
    bool is_over = false;     // nothing waits for the statistics any more: they may be long
};

/// The line that says that the emulator listens: "ready a=127.0.0.1:7001 b=... seed=42 ...".
[[nodiscard]] std::string ready_line(const Run& run);

/// Who is on each side: "a is 127.0.0.1:5000, b is not known yet".
[[nodiscard]] std::string endpoints_line(const ports::Relay& relay);

/// What of each direction differs from the default, as a profile says it.
[[nodiscard]] nlohmann::ordered_json configuration_json(const Path& path);

/// The last `count_max` of the changes that a run saw, each with the settings that changed.
[[nodiscard]] nlohmann::ordered_json changes_json(const ChangeLog& changes, std::size_t count_max);

/// What --stats writes: one JSON object.
[[nodiscard]] nlohmann::ordered_json statistics_of(const Run& run);

/// A few lines for a person.
[[nodiscard]] std::string summary(const Run& run);

/// One short line for a terminal.
[[nodiscard]] std::string status_line(const Run& run);

} // namespace hapnet::emulator

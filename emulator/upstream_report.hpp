// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/options.hpp"
#include "emulator/ports/upstream.hpp"
#include "emulator/scenario.hpp"
#include "proto/base/time.hpp"
#include "proto/net/real_time.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace hapnet::emulator {

/// All that a report on a run with --upstream is made from.
struct UpstreamRun {
    const UpstreamOptions& options;
    const Scenario& scenario;
    const ports::Upstream& port;
    net::RealTime real_time;
    base::Duration elapsed{}; // since the socket was bound
};

/// "ready listen=127.0.0.1:7001 upstream=10.0.0.5:53 seed=42 ..."
[[nodiscard]] std::string ready_line(const UpstreamRun& run);

/// What --stats writes: one JSON object, with the sums of all clients and each that is there.
[[nodiscard]] nlohmann::ordered_json statistics_of(const UpstreamRun& run);

/// A few lines for a person.
[[nodiscard]] std::string summary(const UpstreamRun& run);

/// One short line for a terminal.
[[nodiscard]] std::string status_line(const UpstreamRun& run);

} // namespace hapnet::emulator

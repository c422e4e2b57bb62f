// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/ports/links.hpp"
#include "emulator/ports/upstream.hpp"
#include "emulator/report.hpp"

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

namespace hapnet::emulator {

// Reports on runs with several paths.

using LinksRun = RunOf<ports::Links, true>;
using UpstreamRun = RunOf<ports::Upstream, true>;

/// Returns "ready 1-2=127.0.0.1:7001,127.0.0.1:7002 ... seed=42 ...".
[[nodiscard]] std::string ready_line(const LinksRun& run);
/// Returns "ready listen=127.0.0.1:7001 upstream=10.0.0.5:53 seed=42 ...".
[[nodiscard]] std::string ready_line(const UpstreamRun& run);

/// Returns the statistics that --stats writes: one JSON object, with the sums of all paths and an
/// entry for each existing path.
[[nodiscard]] nlohmann::ordered_json statistics_of(const LinksRun& run, const RunState& state);
[[nodiscard]] nlohmann::ordered_json statistics_of(const UpstreamRun& run, const RunState& state);

/// Adds several links of any kind and their sums to `statistics`, and returns all as JSON. `ends`
/// has the ends of each link; empty: the links have no ends to report.
[[nodiscard]] nlohmann::ordered_json json_of_links(RunStatistics statistics, const AnyRun& run,
                                                   const RunState& state,
                                                   std::span<const LinkEnds> ends = {});

/// Returns the length of a run with several links, and a line for each of their directions.
[[nodiscard]] std::string words_of_links(const AnyRun& run, const RunState& state);

/// Returns a few lines for a person.
[[nodiscard]] std::string summary(const LinksRun& run, const RunState& state);
[[nodiscard]] std::string summary(const UpstreamRun& run, const RunState& state);

/// Returns one short line for a terminal.
[[nodiscard]] std::string status_line(const LinksRun& run, const RunState& state);
[[nodiscard]] std::string status_line(const UpstreamRun& run, const RunState& state);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/monitor/device_news.hpp"
#include "peer/monitor/statistics.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::peer::monitor {

/// Returns the configuration of a peer in the form that records and statistics contain.
[[nodiscard]] nlohmann::ordered_json configuration_json(const Options& options,
                                                        std::string_view device);

/// Returns the JSON that --stats writes at the end. For clients of the control socket, which get it
/// earlier, it has the time since the first tick.
[[nodiscard]] nlohmann::ordered_json statistics_json(const Run& run,
                                                     std::optional<base::Duration> elapsed = {});

/// Returns the peer's settings and state for clients of the control socket, and the state as text
/// for people.
[[nodiscard]] nlohmann::ordered_json show_json(const Run& run, const Recovery& recovery);

/// Returns a summary of a few lines for people.
[[nodiscard]] std::string summary(const Run& run);

} // namespace hapnet::peer::monitor

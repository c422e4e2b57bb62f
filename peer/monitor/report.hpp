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

/// The configuration of a peer as records and statistics carry it.
[[nodiscard]] nlohmann::ordered_json configuration_json(const Options& options,
                                                        std::string_view device);

/// The JSON that --stats writes at the end and that clients of the control socket get meanwhile,
/// with the time since the first tick.
[[nodiscard]] nlohmann::ordered_json statistics_json(const Run& run,
                                                     std::optional<base::Duration> elapsed = {});

/// The peer's settings and state for clients of the control socket, and the state in words for a
/// person.
[[nodiscard]] nlohmann::ordered_json show_json(const Run& run, const Recovery& recovery);

/// A few lines for a person.
[[nodiscard]] std::string summary(const Run& run);

} // namespace hapnet::peer::monitor

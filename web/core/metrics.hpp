// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

namespace hapnet::web {

/// The counters of an emulator and of peers, from their statistics (docs/formats/statistics.md), in
/// the text format of Prometheus, version 0.0.4. `emulator` is null without one. What a statistic
/// does not have, or has as null, has no line.
[[nodiscard]] std::string prometheus_text(const nlohmann::ordered_json& emulator,
                                          std::span<const nlohmann::ordered_json> peers);

} // namespace hapnet::web

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/metrics.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace hapnet::lab::metrics {

// Metrics as one JSON object whose keys are the names of the fields. A value by side is a list of
// two, null where there is no value.

/// Returns the metrics as JSON. It is exact: metrics_from(to_json(m)) == m, as long as all numbers
/// are finite.
[[nodiscard]] nlohmann::ordered_json to_json(const Metrics& metrics);

/// Reads metrics. Returns nullopt when a key is missing or its value cannot be read.
[[nodiscard]] std::optional<Metrics> metrics_from(const nlohmann::json& json);

} // namespace hapnet::lab::metrics

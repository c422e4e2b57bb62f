// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/json.hpp"

#include "proto/base/fields_json.hpp"

namespace hapnet::lab::metrics {

nlohmann::ordered_json to_json(const Metrics& metrics) { return base::json_of(metrics); }

std::optional<Metrics> metrics_from(const nlohmann::json& json)
{
    Metrics metrics;
    return base::read_json(json, metrics) ? std::optional{metrics} : std::nullopt;
}

} // namespace hapnet::lab::metrics

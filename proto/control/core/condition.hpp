// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/condition.hpp"
#include "proto/base/result.hpp"

#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace hapnet::control {

/// Returns the figure that the condition compares; nullopt: it has no value yet (null). If the path
/// leads nowhere or not to a number, the error lists the keys that exist.
[[nodiscard]] base::Result<std::optional<double>> value_in(const nlohmann::ordered_json& statistics,
                                                           const base::Condition& condition);

/// True if the statistics meet the condition. A figure without a value meets no condition. Fails
/// with the errors of value_in().
[[nodiscard]] base::Result<bool> is_met(const base::Condition& condition,
                                        const nlohmann::ordered_json& statistics);

} // namespace hapnet::control

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/condition.hpp"
#include "proto/base/result.hpp"

#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace hapnet::control {

/// The number that the condition is about; nullopt: it has no value yet (null). The error says
/// which keys there are when the path leads nowhere or to something that is no number.
[[nodiscard]] base::Result<std::optional<double>> value_in(const nlohmann::ordered_json& statistics,
                                                           const base::Condition& condition);

/// True if the statistics meet the condition. A figure without a value meets no condition. The
/// error is the error of value_in().
[[nodiscard]] base::Result<bool> is_met(const base::Condition& condition,
                                        const nlohmann::ordered_json& statistics);

} // namespace hapnet::control

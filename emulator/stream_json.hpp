// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/figures/moments.hpp"
#include "proto/base/figures/quantiles.hpp"
#include "proto/base/time.hpp"

#include <nlohmann/json.hpp>
#include <optional>

namespace hapnet::emulator {

// Numbers of a measured as every report writes them, in milliseconds; what is unknown is null.

[[nodiscard]] nlohmann::ordered_json json_in_ms(std::optional<base::Duration> duration);
[[nodiscard]] nlohmann::ordered_json json_in_ms(const std::optional<base::Moments>& moments);
[[nodiscard]] nlohmann::ordered_json json_in_ms(const std::optional<base::Quantiles>& quantiles);

/// The value, or null where it is unknown.
template <typename T>
[[nodiscard]] nlohmann::ordered_json or_null(const std::optional<T>& value)
{
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

} // namespace hapnet::emulator

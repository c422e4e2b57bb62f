// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/stream_json.hpp"

#include <chrono>

namespace hapnet::emulator {

nlohmann::ordered_json json_in_ms(std::optional<base::Duration> duration)
{
    if (!duration) return nullptr;
    return std::chrono::duration<double, std::milli>{*duration}.count();
}

nlohmann::ordered_json json_in_ms(const std::optional<base::Moments>& moments)
{
    if (!moments) return nullptr;
    return {{"mean", json_in_ms(moments->mean)}, {"sd", json_in_ms(moments->sd)}};
}

nlohmann::ordered_json json_in_ms(const std::optional<base::Quantiles>& quantiles)
{
    if (!quantiles) return nullptr;
    return {{"p50", json_in_ms(quantiles->p50)},
            {"p90", json_in_ms(quantiles->p90)},
            {"p99", json_in_ms(quantiles->p99)},
            {"p999", json_in_ms(quantiles->p999)},
            {"max", json_in_ms(quantiles->max)}};
}

} // namespace hapnet::emulator

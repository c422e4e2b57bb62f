// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/checks.hpp"

#include "proto/control/core/condition.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

base::Result<void> ensure_keys(const Checks& checks, const nlohmann::ordered_json& statistics)
{
    for (const base::Condition& check : checks) {
        const auto value = control::value_in(statistics, check);
        if (value) continue;
        return base::fail(
            fmt::format("cannot check {}: {}", to_text(check), value.error().message));
    }
    return {};
}

nlohmann::ordered_json judged(const Checks& checks, const nlohmann::ordered_json& statistics)
{
    auto list = nlohmann::ordered_json::array();
    for (const base::Condition& check : checks) {
        const auto value = control::value_in(statistics, check).value_or(std::optional<double>{});
        list.push_back({{"require", to_text(check)},
                        {"value", value ? nlohmann::ordered_json(*value) : nullptr},
                        {"met", control::is_met(check, statistics).value_or(false)}});
    }
    return list;
}

std::string not_met(const nlohmann::ordered_json& judged_checks)
{
    std::string text;
    for (const auto& check : judged_checks) {
        if (check["met"].get<bool>()) continue;
        const auto& value = check["value"];
        text +=
            fmt::format("NOT MET: {} is required, and it {}\n", check["require"].get<std::string>(),
                        value.is_null() ? std::string{"has no value"}
                                        : fmt::format("is {}", value.get<double>()));
    }
    return text;
}

} // namespace hapnet::emulator

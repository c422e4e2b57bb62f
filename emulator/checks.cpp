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

std::vector<CheckReport> judged(const Checks& checks, const nlohmann::ordered_json& statistics)
{
    std::vector<CheckReport> reports;
    for (const base::Condition& check : checks) {
        reports.push_back({.require = to_text(check),
                           .value = control::value_in(statistics, check).value_or(std::nullopt),
                           .is_met = control::is_met(check, statistics).value_or(false)});
    }
    return reports;
}

std::string not_met(const nlohmann::ordered_json& statistics)
{
    std::string text;
    for (const auto& check : statistics.value("checks", nlohmann::ordered_json::array())) {
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

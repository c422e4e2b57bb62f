// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/doctor/report.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::doctor {

std::string finding_table(const std::vector<Finding>& findings)
{
    std::string text;
    for (const Finding& one : findings) {
        text += fmt::format("{:<4}  {:<15}  {}\n", name_of(one.level), one.subject, one.text);
        if (!one.cure.empty()) text += fmt::format("{:23}fix: {}\n", "", one.cure);
    }
    return text;
}

std::string finding_json(const std::vector<Finding>& findings)
{
    auto rows = nlohmann::json::array();
    for (const Finding& one : findings) {
        rows.push_back({{"subject", one.subject},
                        {"level", name_of(one.level)},
                        {"text", one.text},
                        {"fix", one.cure.empty() ? nlohmann::json{} : nlohmann::json(one.cure)}});
    }
    return nlohmann::json{{"findings", rows}, {"bad", has_bad(findings)}}.dump(2) + "\n";
}

bool has_bad(const std::vector<Finding>& findings)
{
    return std::any_of(findings.begin(), findings.end(),
                       [](const Finding& one) { return one.level == Level::bad; });
}

} // namespace hapnet::peer::doctor

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/doctor/report.hpp"

#include "proto/base/fields_json.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::peer::doctor {

Examination examine(const Facts& facts)
{
    auto findings = judge(facts);
    const bool has_bad =
        std::ranges::any_of(findings, [](const Finding& one) { return one.level == Level::bad; });
    return {has_bad, std::move(findings)};
}

std::string text_of(const Examination& examination)
{
    std::string text;
    for (const Finding& one : examination.findings) {
        text += fmt::format("{:<4}  {:<15}  {}\n", base::name_of(one.level), one.subject, one.text);
        if (one.cure) text += fmt::format("{:23}fix: {}\n", "", *one.cure);
    }
    return text;
}

std::string json_text_of(const Examination& examination)
{
    return base::json_of(examination).dump(2) + "\n";
}

} // namespace hapnet::peer::doctor

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/run_verdict.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

namespace hapnet::web {

namespace {

using Json = nlohmann::ordered_json;

/// Returns the reasons why the run of that program is not valid; empty when it is valid.
std::vector<std::string> reasons_of(const std::string& text)
{
    const auto json = Json::parse(text, nullptr, /*allow_exceptions*/ false);
    if (!json.is_object() || !json.contains("valid")) return {"it wrote no statistics"};
    if (json["valid"] == true) return {};
    std::vector<std::string> reasons;
    const auto list = json.find("invalid_because");
    for (const Json& reason : list != json.end() && list->is_array() ? *list : Json::array()) {
        if (reason.is_string()) reasons.push_back(reason.get<std::string>());
    }
    if (reasons.empty()) reasons.emplace_back("it does not say why");
    return reasons;
}

} // namespace

nlohmann::ordered_json RunVerdict::json() const
{
    return {{"run", run}, {"valid", because.empty()}, {"invalid_because", because}};
}

std::string RunVerdict::text() const
{
    return fmt::format("run {} has ended: {}", run,
                       because.empty() ? "valid"
                                       : fmt::format("not valid: {}", fmt::join(because, "; ")));
}

RunVerdict verdict_of(int run, const std::vector<ProgramStatistics>& programs)
{
    RunVerdict verdict{.run = run, .because = {}};
    for (const ProgramStatistics& program : programs) {
        for (const std::string& reason : reasons_of(program.text))
            verdict.because.push_back(program.name + ": " + reason);
    }
    return verdict;
}

} // namespace hapnet::web

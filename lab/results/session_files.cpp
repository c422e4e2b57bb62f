// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/session_files.hpp"

namespace hapnet::lab::results {

std::vector<std::string> SessionFiles::invalid_because() const
{
    std::vector<std::string> reasons;
    for (const auto& reason : analysis.value("invalid_because", nlohmann::ordered_json::array())) {
        if (reason.is_string()) reasons.push_back(reason.get<std::string>());
    }
    if (!emulator.value("valid", false)) {
        const auto why = emulator.value("invalid_because", nlohmann::ordered_json::array());
        for (const auto& reason : why) {
            if (reason.is_string()) reasons.push_back("emulator: " + reason.get<std::string>());
        }
        if (why.empty()) reasons.emplace_back("the emulator was later than its budget");
    }
    return reasons;
}

} // namespace hapnet::lab::results

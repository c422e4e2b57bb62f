// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/criteria_text.hpp"

#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::lab {

base::Result<Criteria> load_criteria(const std::string& file_or_name, const base::OpenFile& open)
{
    std::vector<std::string_view> names;
    for (const BuiltInCriteria& built_in : built_in_criteria()) {
        if (built_in.name == file_or_name) {
            return parse_criteria(built_in.text, fmt::format("{}.toml", built_in.name));
        }
        names.push_back(built_in.name);
    }
    const bool is_file =
        file_or_name.find('/') != std::string::npos || file_or_name.ends_with(".toml");
    const auto text = open(file_or_name);
    if (!text && is_file) return tl::unexpected{text.error()};
    if (!text) {
        return base::fail(fmt::format("there is neither a file nor criteria '{}': {}", file_or_name,
                                      base::suggestion(file_or_name, names)));
    }
    return parse_criteria(*text, file_or_name);
}

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/parsers.hpp"

#include "proto/base/reading.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <cctype>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>

namespace hapnet::cli {

namespace {

std::string small(std::string_view text)
{
    std::string out;
    for (const char c : text) out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

} // namespace

base::Result<base::Seed> seed(const std::string& text)
{
    return base::parse_count(text, std::numeric_limits<std::uint64_t>::max())
        .map([](std::uint64_t value) { return base::Seed{value}; });
}

Parser<std::string> one_of(std::vector<std::string> words)
{
    return [words = std::move(words)](const std::string& text) -> base::Result<std::string> {
        const auto word = std::find_if(words.begin(), words.end(), [&](const std::string& one) {
            return small(one) == small(text);
        });
        if (word != words.end()) return *word;
        const std::vector<std::string_view> names{words.begin(), words.end()};
        return base::fail(
            fmt::format("unknown value '{}': {}", text, base::suggestion(small(text), names)));
    };
}

} // namespace hapnet::cli

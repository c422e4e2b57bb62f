// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/reading.hpp"

#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::base {

/// A text, and the name by which error messages refer to it.
struct NamedText {
    std::string source;
    std::string text;
};

/// A text that is compiled into a program, so that it is available without a file.
struct BuiltInText {
    std::string_view name;
    std::string text;
};

/// Returns the built-in text with the given name. If there is none, returns the text of the file
/// with that name, as `open` gives it. `kind` says in errors what the text describes: "a scene".
/// BuiltIn has the members `name`, without .toml, and `text`.
template <typename BuiltIn>
[[nodiscard]] Result<NamedText> find_text(const std::string& file_or_name,
                                          std::span<const BuiltIn> all, std::string_view kind,
                                          const OpenFile& open)
{
    std::vector<std::string_view> names;
    for (const BuiltIn& one : all) {
        if (one.name == file_or_name) {
            return NamedText{fmt::format("{}.toml", one.name), std::string{one.text}};
        }
        names.push_back(one.name);
    }
    auto text = open(file_or_name);
    if (text) return NamedText{file_or_name, *std::move(text)};
    const bool is_file =
        file_or_name.find('/') != std::string::npos || file_or_name.ends_with(".toml");
    if (is_file) return tl::unexpected{text.error()};
    return fail(fmt::format("there is neither a file nor {} '{}': {}", kind, file_or_name,
                            suggestion(file_or_name, names)));
}

} // namespace hapnet::base

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/plain.hpp"

namespace hapnet::output {

std::string plain(std::string_view words)
{
    std::string text;
    while (!words.empty()) {
        const char c = words.front();
        words.remove_prefix(1);
        if (c == ']' && words.starts_with('(')) {
            const auto end = words.find(')');
            words.remove_prefix(end == std::string_view::npos ? words.size() : end + 1);
        } else if (c != '`' && c != '[' && c != ']') {
            text += c;
        }
    }
    return text;
}

} // namespace hapnet::output

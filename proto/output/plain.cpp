// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/plain.hpp"

#include <algorithm>

namespace hapnet::output {

std::string plain(std::string_view words)
{
    std::string text;
    while (!words.empty()) {
        const char c = words.front();
        words.remove_prefix(1);
        if (c == ']' && words.starts_with('(')) {
            words.remove_prefix(std::min(words.find(')') + 1, words.size()));
        } else if (c != '`' && c != '[' && c != ']') {
            text += c;
        }
    }
    return text;
}

} // namespace hapnet::output

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/fields.hpp"

namespace hapnet::base {

namespace {

/// One line, whose bars do not end a cell.
std::string cell(std::string_view text)
{
    std::string line;
    for (const char c : text) {
        if (c == '|') line += '\\';
        line += c == '\n' ? ' ' : c;
    }
    return line;
}

} // namespace

std::string markdown(const std::vector<KeyRow>& rows)
{
    std::string text = "| key | value | default | meaning |\n|---|---|---|---|\n";
    for (const KeyRow& row : rows) {
        const bool is_value = !row.by_default.empty() && row.by_default != KeyRow::required;
        const std::string usual = is_value ? fmt::format("`{}`", row.by_default) : row.by_default;
        text += fmt::format("| `{}` | {} | {} | {} |\n", row.key, cell(row.values), cell(usual),
                            cell(row.about));
    }
    return text;
}

} // namespace hapnet::base

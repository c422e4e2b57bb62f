// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/fields.hpp"

namespace hapnet::base {

std::string markdown(const std::vector<KeyRow>& rows)
{
    std::string text = "| key | value | default | |\n|---|---|---|---|\n";
    for (const KeyRow& row : rows) {
        const std::string usual = row.by_default.empty() ? "" : fmt::format("`{}`", row.by_default);
        text += fmt::format("| `{}` | {} | {} | {} |\n", row.key, row.values, usual, row.about);
    }
    return text;
}

} // namespace hapnet::base

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/key_table.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::output {

namespace {

using Shape = base::ValueKind::Shape;

const base::FieldTable* record_of(const base::FieldRow& row)
{
    const base::ValueKind& kind = row.kind->plain().plain();
    return kind.shape == Shape::record ? &kind.table() : nullptr;
}

std::string cell(std::string_view words)
{
    std::string text;
    for (const char c : words) text += c == '|' ? std::string{"\\|"} : std::string{c};
    return text;
}

void add_row(std::string& text, const std::string& keys, std::string_view about)
{
    text += fmt::format("| {} | {} |\n", keys, cell(about));
}

void add_rows(std::string& text, const base::FieldTable& fields, const std::string& prefix)
{
    for (const base::FieldRow& row : fields.rows) {
        const std::string key = prefix + std::string{row.key};
        const base::FieldTable* const inner = record_of(row);
        if (inner == nullptr) {
            if (!row.about.empty()) add_row(text, fmt::format("`{}`", key), row.about);
            continue;
        }
        std::string keys;
        for (const base::FieldRow& one : inner->rows) {
            if (!one.about.empty() || record_of(one) != nullptr) continue;
            keys += keys.empty() ? fmt::format("`{}.{}`", key, one.key)
                                 : fmt::format(", `.{}`", one.key);
        }
        const bool has_own_table = keys.empty() && !row.about.empty();
        if (!row.about.empty())
            add_row(text, keys.empty() ? fmt::format("`{}`", key) : keys, row.about);
        if (!has_own_table) add_rows(text, *inner, key + '.');
    }
}

} // namespace

std::string key_table(const base::FieldTable& fields)
{
    std::string text = "| key | meaning |\n|---|---|\n";
    add_rows(text, fields, {});
    return text;
}

} // namespace hapnet::output

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/told.hpp"

#include "proto/base/ensure.hpp"

#include <cstdint>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <variant>

namespace hapnet::output {

namespace {

using Shape = base::ValueKind::Shape;

std::string_view unit_of(std::string_view key)
{
    if (key.ends_with("_us")) return " (µs)";
    if (key.ends_with("_ms")) return " (ms)";
    return key.ends_with("_s") ? " (s)" : "";
}

/// Appends a count such as "3 lost" to the text.
void add(std::string& text, std::uint64_t count, std::string_view words)
{
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, words);
}

std::uint64_t count_in(const base::ValueKind& kind, const void* value)
{
    base::ensure(kind.shape == Shape::whole && !kind.is_signed);
    return std::get<std::uint64_t>(kind.get(value));
}

} // namespace

std::string told(const base::FieldTable& fields, const void* value)
{
    std::string text;
    for (const base::FieldRow& row : fields.rows) {
        const base::Telling& telling = row.telling;
        if (!telling.words) continue;
        row.look(value, [&](const void* member) {
            const base::ValueKind& kind = *row.kind;
            if (kind.shape == Shape::map) {
                for (std::size_t i = 0; i < kind.size(member); ++i) {
                    const auto count = count_in(*kind.element, kind.element_at(member, i));
                    if (count > 0) add(text, count, kind.name_at(member, i));
                }
                return;
            }
            if (kind.shape != Shape::whole) return; // other shapes appear in tables only
            const auto count = count_in(kind, member);
            if (count > 0 || telling.is_told_always) add(text, count, *telling.words);
        });
    }
    return text;
}

std::vector<ToldFigure> told_figures(const base::FieldTable& fields,
                                     const nlohmann::ordered_json& json)
{
    std::vector<ToldFigure> figures;
    for (const base::FieldRow& row : fields.rows) {
        const auto found = json.find(row.key);
        if (found == json.end() || found->is_null()) continue;
        const base::ValueKind& kind = row.kind->plain();
        if (!row.telling.words) {
            if (kind.shape != Shape::record) continue;
            const auto inner = told_figures(kind.table(), *found);
            figures.insert(figures.end(), inner.begin(), inner.end());
        } else if (kind.shape == Shape::map) {
            for (const auto& [name, count] : found->items()) {
                if (count != 0) figures.push_back({fmt::format("{}: {}", row.key, name), count});
            }
        } else if (found->is_object()) {
            for (const auto& [key, value] : found->items()) {
                if (!value.is_number()) continue;
                figures.push_back(
                    {fmt::format("{}, {}{}", *row.telling.words, key, unit_of(row.key)), value});
            }
        } else {
            figures.push_back({fmt::format("{}{}", *row.telling.words, unit_of(row.key)), *found});
        }
    }
    return figures;
}

} // namespace hapnet::output

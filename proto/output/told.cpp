// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/told.hpp"

#include "proto/base/ensure.hpp"

#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <variant>

namespace hapnet::output {

namespace {

using Shape = base::ValueKind::Shape;

/// Adds "3 lost" behind what is there.
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
            const auto count = count_in(kind, member);
            if (count > 0 || telling.is_told_always) add(text, count, *telling.words);
        });
    }
    return text;
}

} // namespace hapnet::output

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/field_table.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::base {

namespace {

/// Returns the table to write if a struct is missing: `write [limit.delay] with to, step,
/// resolution`.
std::string cure_of_missing_table(const FieldRow& row)
{
    std::string name{row.key};
    const FieldTable* table = &row.kind->plain().table();
    const auto inner_of = [](const FieldTable& of) -> const FieldRow* {
        const auto is_table = [](const FieldRow& one) {
            return one.kind->plain().shape == ValueKind::Shape::record;
        };
        const bool are_tables = !of.rows.empty() && std::ranges::all_of(of.rows, is_table);
        return are_tables ? &of.rows.front() : nullptr;
    };
    while (const FieldRow* inner = inner_of(*table)) {
        name += fmt::format(".{}", inner->key);
        table = &inner->kind->plain().table();
    }
    std::vector<std::string_view> required;
    for (const FieldRow& one : table->rows) {
        if (one.is_required) required.push_back(one.key);
    }
    if (required.empty()) return fmt::format("write a table [{}]", name);
    return fmt::format("write [{}] with {}", name, fmt::join(required, ", "));
}

/// Returns the advice for a missing field: an example (`write sd = "10ms"`), the names to choose
/// from, or a description of the allowed values.
std::string cure_of_missing(const FieldRow& row)
{
    const ValueKind& plain = row.kind->plain();
    if (plain.shape == ValueKind::Shape::choice) {
        return fmt::format("use one of {}", fmt::join(plain.names, ", "));
    }
    if (plain.shape == ValueKind::Shape::record) return cure_of_missing_table(row);
    const std::string example = row.written->example(row.format);
    if (!example.empty()) return fmt::format("write {} = {}", row.key, example);
    return fmt::format("expected {}", row.written->describe(row.format));
}

/// Adds the rows of a struct and of the structs in it. `usual` has the defaults.
void add_key_rows(std::vector<KeyRow>& rows, const FieldTable& fields, const void* usual,
                  const std::string& prefix)
{
    for (const FieldRow& row : fields.rows) {
        const std::string key = prefix + std::string{row.key};
        const ValueKind& plain = row.kind->plain();
        if (plain.shape == ValueKind::Shape::record) {
            const FieldTable& inner = plain.table();
            const bool is_maybe = row.kind != &plain;
            const auto first = rows.size();
            add_key_rows(rows, inner, is_maybe ? inner.defaults : row.in(usual), key + '.');
            auto about = row.about;
            if (about.ends_with('.')) about.remove_suffix(1);
            for (auto i = first; i < rows.size() && !about.empty(); ++i) {
                rows[i].about = fmt::format("{}: {}", about, rows[i].about);
            }
            continue;
        }
        // A field that is printed only where another member is set has no default there.
        const bool has_default = !row.is_required && !row.printed_if;
        std::string by_default{row.is_required ? KeyRow::required : ""};
        if (has_default) by_default = field_text(row, usual).value_or("");
        rows.push_back({key, allowed(row), by_default, std::string{row.about}});
    }
}

/// Returns text for a table cell: on one line, with bars escaped.
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

const void* FieldRow::in(const void* owner) const
{
    ensure(compute == nullptr && find == nullptr);
    return static_cast<const std::byte*>(owner) + offset;
}

void* FieldRow::in(void* owner) const
{
    ensure(compute == nullptr && find == nullptr);
    return static_cast<std::byte*>(owner) + offset;
}

void FieldRow::look(const void* owner, const UseValue& use) const
{
    const void* const whole = find != nullptr ? find(owner) : owner;
    const void* const of = static_cast<const std::byte*>(whole) + offset;
    if (compute != nullptr) return compute(of, use);
    use(of);
}

std::optional<double> time_unit_of(std::string_view key)
{
    constexpr std::array<std::pair<std::string_view, double>, 4> units{
        {{"_ns", 1.0}, {"_us", 1e3}, {"_ms", 1e6}, {"_s", 1e9}}};
    for (const auto& [suffix, nanoseconds] : units) {
        if (key.ends_with(suffix)) return nanoseconds;
    }
    return std::nullopt;
}

std::string allowed(const FieldRow& row)
{
    ensure(row.written != nullptr);
    std::string text;
    const ValueKind& plain = row.kind->plain();
    if (plain.shape == ValueKind::Shape::choice) {
        for (const std::string_view name : plain.names) {
            text += fmt::format("{}`{}`", text.empty() ? "" : ", ", quoted(name));
        }
    } else {
        text = row.written->describe(row.format);
    }
    if (!row.absent.empty()) text += fmt::format(", or `{}`", quoted(row.absent));
    return text;
}

void read_field(const FieldRow& row, const Node& node, void* owner, Reading& reading)
{
    ensure(row.written != nullptr);
    void* const member = row.in(owner);
    const ValueKind& kind = *row.kind;
    if (kind.shape != ValueKind::Shape::maybe) {
        return row.written->read(row.format, node, member, reading);
    }
    const auto* word = std::get_if<std::string>(&node.value);
    if (!row.absent.empty() && word != nullptr && *word == row.absent) {
        return kind.clear(member);
    }
    const bool is_new = kind.size(member) == 0;
    void* const value = is_new ? kind.add(member) : kind.at(member, 0);
    row.written->read(row.format, node, value, reading);
    if (is_new && !reading.is_good()) kind.clear(member);
}

std::optional<std::string> field_text(const FieldRow& row, const void* owner)
{
    ensure(row.written != nullptr);
    const void* member = row.in(owner);
    if (row.kind->shape == ValueKind::Shape::maybe) {
        if (row.kind->size(member) == 0) {
            return row.absent.empty() ? std::nullopt : std::optional{quoted(row.absent)};
        }
        member = row.kind->element_at(member, 0);
    }
    return row.written->print(row.format, member);
}

void read_fields(const FieldTable& fields, TableReader& table, void* target)
{
    for (const FieldRow& row : fields.rows) {
        const Node* node = table.find(row.key);
        if (node == nullptr && row.is_required) {
            std::ignore = table.require(row.key, cure_of_missing(row));
        }
        if (node != nullptr) read_field(row, *node, target, table.reading());
    }
}

void read_table(const FieldTable& fields, const Node& node, void* target, Reading& reading)
{
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) return complain_of(node, "a table", reading);
    TableReader table{*entries, node.place, reading};
    read_fields(fields, table, target);
    table.finish();
}

std::vector<std::string> field_texts(const FieldTable& fields, const void* value, Print print)
{
    std::vector<std::string> texts;
    for (const FieldRow& row : fields.rows) {
        const auto text = field_text(row, value);
        bool is_printed = print == Print::all || row.is_always_printed;
        if (row.printed_if) {
            is_printed |= *static_cast<const bool*>(
                static_cast<const void*>(static_cast<const std::byte*>(value) + *row.printed_if));
        }
        if (text && (is_printed || text != field_text(row, fields.defaults))) {
            texts.push_back(fmt::format("{} = {}", row.key, *text));
        }
    }
    return texts;
}

std::string field_lines(const FieldTable& fields, const void* value, const std::string& prefix)
{
    std::string lines;
    for (const FieldRow& row : fields.rows) {
        const std::string key = prefix + std::string{row.key};
        if (row.kind->shape == ValueKind::Shape::record) {
            lines += field_lines(row.kind->table(), row.in(value), key + '.');
        } else if (const auto text = field_text(row, value)) {
            lines += key + " = " + *text + '\n';
        }
    }
    return lines;
}

std::vector<KeyRow> key_rows(const FieldTable& fields, const std::string& prefix,
                             const void* defaults)
{
    std::vector<KeyRow> rows;
    add_key_rows(rows, fields, defaults, prefix);
    return rows;
}

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

std::size_t detail::offset_in(const void* whole, const void* part)
{
    return static_cast<std::size_t>(static_cast<const std::byte*>(part) -
                                    static_cast<const std::byte*>(whole));
}

} // namespace hapnet::base

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/field_table.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/value_kind.hpp"

#include <concepts>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace hapnet::base {

// Functions that read and print structs as text, by their field tables.

/// Reads the fields that the TOML table contains. The other fields keep their values. Complains of
/// required fields that are missing. The table may have other keys, so the caller has to call
/// finish().
template <Described T>
void read_fields(TableReader& table, T& target)
{
    read_fields(field_table<T>(), table, &target);
}

/// Reads the fields of a table that must not have other keys.
template <Described T>
void read_table(const Node& node, T& target, Reading& reading)
{
    read_table(field_table<T>(), node, &target, reading);
}

/// Returns one text for each field that is printed: `half_width = "15ms"`. A value differs from its
/// default if its text does: -0 differs from 0.
template <Described T>
[[nodiscard]] std::vector<std::string> field_texts(const T& value, Print print = Print::all)
{
    return field_texts(field_table<T>(), &value, print);
}

/// Returns the texts of field_texts(), one per line. Fields of nested structs have dotted keys:
/// `reflex.gain = 0.5`.
template <Described T>
[[nodiscard]] std::string field_lines(const T& value, const std::string& prefix = {})
{
    return field_lines(field_table<T>(), &value, prefix);
}

/// Returns the rows of a table of the keys of T.
template <Described T>
[[nodiscard]] std::vector<KeyRow> key_rows(const std::string& prefix = {}, const T& defaults = {})
{
    return key_rows(field_table<T>(), prefix, &defaults);
}

template <Described T>
void Table::read(const Node& node, T& target, Reading& reading) const
{
    T value = target;
    read_table(node, value, reading);
    if (reading.is_good()) target = std::move(value);
}

template <Described T>
std::string Table::print(const T& value) const
{
    return table_text(field_texts(value));
}

// Helpers that build a field table.

namespace detail {

/// The functions that read and print texts of a Value in a Format.
template <typename Format, typename Value>
inline constexpr WrittenAs written_as{
    .read =
        [](const void* format, const Node& node, void* value, Reading& reading) {
            static_cast<const Format*>(format)->read(node, *static_cast<Value*>(value), reading);
        },
    .print = [](const void* format, const void* value) -> std::string {
        return static_cast<const Format*>(format)->print(*static_cast<const Value*>(value));
    },
    .describe = [](const void* format) -> std::string {
        return static_cast<const Format*>(format)->describe();
    },
    .example = [](const void* format) -> std::string {
        if constexpr (requires { static_cast<const Format*>(format)->example(); }) {
            return static_cast<const Format*>(format)->example();
        } else {
            return {};
        }
    }};

/// Adds a row. The offset of its member counts from `root`, the first byte of the whole struct.
template <typename Struct, typename Value, typename Format, std::derived_from<Struct> Owner>
void add_row(std::vector<FieldRow>& rows, const void* root,
             const Field<Struct, Value, Format>& field, const Owner& owner)
{
    FieldRow row{.key = field.key,
                 .about = field.about,
                 .absent = field.absent,
                 .offset = offset_in(root, &(owner.*field.member)),
                 .kind = &Kind<Value>::kind,
                 .telling = field.telling,
                 .format = &field.format,
                 .is_required = field.is_required,
                 .is_always_printed = field.is_always_printed};
    if (field.printed_if != nullptr) row.printed_if = offset_in(root, &(owner.*field.printed_if));
    if constexpr (!std::is_same_v<Format, Unwritten>) {
        row.written = &written_as<Format, WithoutOptional<Value>>;
    }
    if constexpr (requires { field.format.decimals; }) row.decimals = field.format.decimals;
    if constexpr (requires { Format::is_spare; }) row.is_spare = true;
    rows.push_back(row);
}

template <typename Struct>
void add_rows(std::vector<FieldRow>& rows, const void* root, const Struct& owner);

/// The type that the lambda of a description returns for a Struct.
template <typename Struct, typename Compute>
using ComputedBy = std::remove_cvref_t<std::invoke_result_t<Compute, const Struct&>>;

template <typename Struct, typename Compute, typename Owner>
void add_row(std::vector<FieldRow>& rows, const void* root, const Computed<Struct, Compute>& figure,
             const Owner& owner)
{
    const Struct& own = owner; // Struct may be a base class of Owner
    FieldRow row{.key = figure.key,
                 .about = figure.about,
                 .offset = offset_in(root, &own),
                 .compute =
                     [](const void* of, const UseValue& use) {
                         const auto& value = Compute{}(*static_cast<const Struct*>(of));
                         use(&value);
                     },
                 .kind = &Kind<ComputedBy<Struct, Compute>>::kind,
                 .telling = figure.telling};
    rows.push_back(row);
}

template <typename Struct, typename Compute, typename Owner>
void add_row(std::vector<FieldRow>& rows, const void* root,
             const ComputedPart<Struct, Compute>& /*part*/, const Owner& owner)
{
    static_assert(std::is_lvalue_reference_v<std::invoke_result_t<Compute, const Struct&>>);
    const Struct& own = owner;
    ensure(static_cast<const void*>(&own) == root);
    for (FieldRow row : field_table<ComputedBy<Struct, Compute>>().rows) {
        ensure(row.find == nullptr);
        row.find = [](const void* whole) -> const void* {
            return &Compute{}(*static_cast<const Struct*>(whole));
        };
        rows.push_back(row);
    }
}

template <typename Struct, typename Value, std::derived_from<Struct> Owner>
void add_row(std::vector<FieldRow>& rows, const void* root, const Part<Struct, Value>& part,
             const Owner& owner)
{
    const auto first = rows.size();
    add_rows(rows, root, owner.*part.member);
    for (auto i = first; i < rows.size(); ++i) {
        rows[i].telling.is_without_zeros |= part.is_without_zeros;
    }
}

template <typename Struct>
void add_rows(std::vector<FieldRow>& rows, const void* root, const Struct& owner)
{
    std::apply([&](const auto&... member) { (add_row(rows, root, member, owner), ...); },
               description<Struct>.members);
}

} // namespace detail

template <Described T>
const FieldTable& field_table()
{
    static const T defaults{};
    static const FieldTable table = [] {
        FieldTable made{.name = described_name<T>, .defaults = &defaults, .rows = {}};
        detail::add_rows(made.rows, &defaults, defaults);
        return made;
    }();
    return table;
}

} // namespace hapnet::base

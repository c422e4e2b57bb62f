// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/value_kind.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::base {

// A table that describes the fields of a struct as data. Code that reads and prints structs takes
// such a table and a pointer to the struct, and knows no types. fields.hpp makes the tables from
// descriptions, and has the same functions for a struct whose type is known.

/// The functions that read and print texts of values of one type in one format: those of a format
/// (formats.hpp), given the format and a value without their types.
struct WrittenAs {
    void (*read)(const void* format, const Node& node, void* value, Reading& reading);
    std::string (*print)(const void* format, const void* value);
    std::string (*describe)(const void* format);
    std::string (*example)(const void* format); // empty: the format has no example
};

/// Uses a value that exists only during the call.
using UseValue = std::function<void(const void* value)>;

/// A member of a struct, or a figure that is computed of it, as describe.hpp describes it.
struct FieldRow {
    std::string_view key{};
    std::string_view about{};
    std::string_view absent{};
    /// Bytes from the start of the struct to the member, or to the source of a computed figure.
    std::size_t offset = 0;
    /// Makes a computed value and passes it on. nullptr: the row is a member.
    void (*compute)(const void* of, const UseValue& use) = nullptr;
    /// Finds the struct that holds the member, if it is not the owner itself. nullptr: it is the
    /// owner.
    const void* (*find)(const void* owner) = nullptr;
    const ValueKind* kind = nullptr;
    Telling telling{};
    const void* format = nullptr;
    const WrittenAs* written = nullptr;      // nullptr: the field stands in no text
    std::optional<int> decimals{};           // decimals in CSV; nullopt: as many as needed
    std::optional<std::size_t> printed_if{}; // offset of the bool that makes it printed
    bool is_required = false;
    bool is_always_printed = false;
    bool is_spare = false;

    /// The place of a member.
    [[nodiscard]] const void* in(const void* owner) const;
    [[nodiscard]] void* in(void* owner) const;
    /// Hands on the value, whether member or computed.
    void look(const void* owner, const UseValue& use) const;
};

struct FieldTable {
    std::string_view name;          // name of the struct where a text names it: the law of a loss
    const void* defaults = nullptr; // a struct that holds the defaults
    std::vector<FieldRow> rows;
};

/// Returns the nanoseconds of the time unit that a key ends with: 1000 for "late_us"; nullopt: no
/// unit.
[[nodiscard]] std::optional<double> time_unit_of(std::string_view key);

/// Returns a description of the values that a field accepts, for people: "a time from 0ms to 10s".
[[nodiscard]] std::string allowed(const FieldRow& row);

/// Reads one member from its value in a text.
void read_field(const FieldRow& row, const Node& node, void* owner, Reading& reading);
/// Returns the value as TOML; nullopt: an optional without a value.
[[nodiscard]] std::optional<std::string> field_text(const FieldRow& row, const void* owner);

void read_fields(const FieldTable& fields, TableReader& table, void* target);
void read_table(const FieldTable& fields, const Node& node, void* target, Reading& reading);

/// The fields to print: all, or those that are required or differ from the default.
enum class Print { all, needed };

[[nodiscard]] std::vector<std::string> field_texts(const FieldTable& fields, const void* value,
                                                   Print print);
[[nodiscard]] std::string field_lines(const FieldTable& fields, const void* value,
                                      const std::string& prefix = {});

/// A row of a table of keys, as people read it.
struct KeyRow {
    std::string key;
    std::string values;     // what may be written: "a time from 0ms to 10s"
    std::string by_default; // default as it is written, or "required"; empty: no default
    std::string about;

    static constexpr std::string_view required = "required";
};

/// `defaults`: a struct that has them.
[[nodiscard]] std::vector<KeyRow> key_rows(const FieldTable& fields, const std::string& prefix,
                                           const void* defaults);

/// Rows as a table of Markdown, as it stands in the docs.
[[nodiscard]] std::string markdown(const std::vector<KeyRow>& rows);

namespace detail {

[[nodiscard]] std::size_t offset_in(const void* whole, const void* part);

} // namespace detail

} // namespace hapnet::base

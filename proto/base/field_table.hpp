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

// Tables that describe the fields of a struct as data. Code that reads and prints structs takes
// such a table and a pointer to the struct, and does not depend on types. fields.hpp makes the
// tables from descriptions, and has the same functions for structs of a known type.

/// The functions of a format (formats.hpp) that read and print texts of values, with the types of
/// the format and of the value erased.
struct WrittenAs {
    void (*read)(const void* format, const Node& node, void* value, Reading& reading);
    std::string (*print)(const void* format, const void* value);
    std::string (*describe)(const void* format);
    std::string (*example)(const void* format); // returns "" if the format has no example
};

/// A function that uses a value. The value exists only during the call.
using UseValue = std::function<void(const void* value)>;

/// A member of a struct, or a figure that is computed from it, as describe.hpp describes it.
struct FieldRow {
    std::string_view key{};
    std::string_view about{};
    std::string_view absent{};
    /// The offset in bytes from the start of the struct to the member, or to the source of a
    /// computed figure.
    std::size_t offset = 0;
    /// Computes a value from `of` and passes it to `use`. nullptr: the row is a member.
    void (*compute)(const void* of, const UseValue& use) = nullptr;
    /// Returns the struct that holds the member. nullptr: the owner itself holds it.
    const void* (*find)(const void* owner) = nullptr;
    const ValueKind* kind = nullptr;
    Telling telling{};
    const void* format = nullptr;
    const WrittenAs* written = nullptr;      // nullptr: the field is not part of any text
    std::optional<int> decimals{};           // decimals in CSV; nullopt: as many as needed
    std::optional<std::size_t> printed_if{}; // offset of the bool that forces it to be printed
    bool is_required = false;
    bool is_always_printed = false;
    bool is_spare = false;

    /// Returns the address of the member.
    [[nodiscard]] const void* in(const void* owner) const;
    [[nodiscard]] void* in(void* owner) const;
    /// Passes the value of the member or of the computed figure to `use`.
    void look(const void* owner, const UseValue& use) const;
};

struct FieldTable {
    std::string_view name;          // name of the struct, if texts contain it: the law of a loss
    const void* defaults = nullptr; // a struct that holds the defaults
    std::vector<FieldRow> rows;
};

/// Returns the length of the time unit that a key ends with, in nanoseconds: 1000 for "late_us".
/// nullopt: the key has no unit.
[[nodiscard]] std::optional<double> time_unit_of(std::string_view key);

/// Returns a description of the values that a field accepts, for people: "a time from 0ms to 10s".
[[nodiscard]] std::string allowed(const FieldRow& row);

/// Reads one member from its value in a text.
void read_field(const FieldRow& row, const Node& node, void* owner, Reading& reading);
/// Returns the value as TOML. nullopt: it is an optional without a value.
[[nodiscard]] std::optional<std::string> field_text(const FieldRow& row, const void* owner);

void read_fields(const FieldTable& fields, TableReader& table, void* target);
void read_table(const FieldTable& fields, const Node& node, void* target, Reading& reading);

/// The fields to print: all, or those that are required or differ from the default.
enum class Print { all, needed };

[[nodiscard]] std::vector<std::string> field_texts(const FieldTable& fields, const void* value,
                                                   Print print);
[[nodiscard]] std::string field_lines(const FieldTable& fields, const void* value,
                                      const std::string& prefix = {});

/// A row of a table of keys for people.
struct KeyRow {
    std::string key;
    std::string values;     // the allowed values: "a time from 0ms to 10s"
    std::string by_default; // default as it is written, or "required"; empty: no default
    std::string about;

    static constexpr std::string_view required = "required";
};

/// Returns a row for each key. `defaults` points to a struct with the default values.
[[nodiscard]] std::vector<KeyRow> key_rows(const FieldTable& fields, const std::string& prefix,
                                           const void* defaults);

/// Returns the rows as a Markdown table, as the docs contain it.
[[nodiscard]] std::string markdown(const std::vector<KeyRow>& rows);

namespace detail {

[[nodiscard]] std::size_t offset_in(const void* whole, const void* part);

} // namespace detail

} // namespace hapnet::base

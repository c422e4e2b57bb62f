// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/profile/form.hpp"
#include "proto/base/reading.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hapnet::emulator {

using base::DocumentError;
using base::list_text;
using base::Node;
using base::OpenFile;
using base::parse_document;
using base::Place;
using base::read_value;
using base::Reading;
using base::suggestion;
using base::table_text;
using base::TableReader;
using base::value_text;

// The values of parameters. What is wrong is complained of, and leaves the target as it was.

void read_value(const Node& node, std::variant<base::Duration, std::uint32_t>& target,
                Reading& reading);
void read_value(const Node& node, Displacement& target, Reading& reading);
void read_value(const Node& node, std::vector<std::uint64_t>& target, Reading& reading);
void read_value(const Node& node, std::vector<bool>& target, Reading& reading);
void read_value(const Node& node, std::vector<Window>& target, Reading& reading);
/// Bytes or bits per second.
void read_whole(const Node& node, std::uint64_t& target, Counts counts, Reading& reading);

template <typename T>
void read_value(const Node& node, std::optional<T>& target, Reading& reading)
{
    T value{};
    read_value(node, value, reading);
    target = value;
}

template <typename T, typename Value>
void read_field(const Node& node, const Field<T, Value>& field, T& target, Reading& reading)
{
    if constexpr (std::is_same_v<Value, std::uint64_t>) {
        read_whole(node, target.*field.member, field.counts, reading);
    } else {
        read_value(node, target.*field.member, reading);
    }
}

/// The parameters of T from the entries of a table.
template <typename T>
[[nodiscard]] T read_fields(TableReader& table)
{
    T target = Form<T>::defaults();
    const auto read = [&](const auto& field) {
        const Node* node =
            field.need == Need::required ? table.require(field.key) : table.find(field.key);
        if (node != nullptr) read_field(*node, field, target, table.reading());
    };
    std::apply([&](const auto&... fields) { (read(fields), ...); }, Form<T>::fields);
    return target;
}

// How parameters are printed: as TOML that reads back as the same value.

[[nodiscard]] std::string value_text(const std::variant<base::Duration, std::uint32_t>& value);
[[nodiscard]] std::string value_text(const Displacement& value);
[[nodiscard]] std::string value_text(const std::vector<std::uint64_t>& value);
[[nodiscard]] std::string value_text(const std::vector<bool>& value);
[[nodiscard]] std::string value_text(const std::vector<Window>& value);
[[nodiscard]] std::string whole_value_text(std::uint64_t value, Counts counts);

template <typename T>
[[nodiscard]] std::string value_text(const std::optional<T>& value)
{
    return value_text(value.value_or(T{}));
}

template <typename T, typename Value>
[[nodiscard]] std::string field_text(const Field<T, Value>& field, const T& of)
{
    if constexpr (std::is_same_v<Value, std::uint64_t>) {
        return whole_value_text(of.*field.member, field.counts);
    } else {
        return value_text(of.*field.member);
    }
}

/// `half_width = "15ms"`, each that has to be said.
template <typename T>
[[nodiscard]] std::vector<std::string> field_texts(const T& of)
{
    const T defaults = Form<T>::defaults();
    std::vector<std::string> texts;
    const auto add = [&](const auto& field) {
        if (field.need == Need::optional && of.*field.member == defaults.*field.member) return;
        texts.push_back(std::string{field.key} + " = " + field_text(field, of));
    };
    std::apply([&](const auto&... fields) { (add(fields), ...); }, Form<T>::fields);
    return texts;
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/profile/document.hpp"
#include "emulator/core/profile/form.hpp"
#include "proto/base/result.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hapnet::emulator {

/// Gives the text of a file that a profile names, or says why not.
using OpenFile = std::function<base::Result<std::string>(const std::string& name)>;

/// The reading of one text: keeps the first complaint about it.
class Reading {
public:
    /// `source` names the text in complaints, as "FILE:LINE:COLUMN: ...". Without `has_lines` it
    /// is an option and stands alone: "up.delay: ...".
    Reading(std::string source, const OpenFile& open, bool has_lines = true)
        : source_{std::move(source)}, open_{open}, has_lines_{has_lines}
    {}

    void complain(Place place, std::string_view what);
    [[nodiscard]] bool is_good() const { return !complaint_; }
    [[nodiscard]] const std::optional<std::string>& complaint() const { return complaint_; }

    [[nodiscard]] base::Result<std::string> open(const std::string& name) const;

private:
    std::string source_;
    const OpenFile& open_;
    bool has_lines_;
    std::optional<std::string> complaint_;
};

/// "did you mean 'jitter'?" or "one of delay, jitter, ... is possible here".
[[nodiscard]] std::string suggestion(std::string_view word,
                                     std::span<const std::string_view> possible);

/// Reads the entries of a table by their keys and complains of those that nobody asked for.
class TableReader {
public:
    TableReader(const Node::Table& table, Place place, Reading& reading)
        : table_{table}, place_{place}, reading_{reading}
    {}

    /// nullptr when it is not there.
    [[nodiscard]] const Node* find(std::string_view key);
    /// Complains when it is not there.
    [[nodiscard]] const Node* require(std::string_view key);
    /// To be called once all keys have been asked for.
    void finish() const;

    [[nodiscard]] Place place() const { return place_; }
    [[nodiscard]] Reading& reading() const { return reading_; }

private:
    const Node::Table& table_;
    Place place_;
    Reading& reading_;
    std::vector<std::string_view> known_;
};

// The values of parameters. What is wrong is complained of, and leaves the target as it was.

void read_value(const Node& node, base::Duration& target, Reading& reading);
void read_value(const Node& node, base::Probability& target, Reading& reading);
void read_value(const Node& node, double& target, Reading& reading);
void read_value(const Node& node, std::uint8_t& target, Reading& reading);
void read_value(const Node& node, std::uint32_t& target, Reading& reading);
void read_value(const Node& node, std::string& target, Reading& reading);
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

[[nodiscard]] std::string quoted(std::string_view text);
[[nodiscard]] std::string value_text(base::Duration value);
[[nodiscard]] std::string value_text(base::Probability value);
[[nodiscard]] std::string value_text(double value);
[[nodiscard]] std::string value_text(std::uint8_t value);
[[nodiscard]] std::string value_text(std::uint32_t value);
[[nodiscard]] std::string value_text(const std::string& value);
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

/// `{ a = 1, b = 2 }`
[[nodiscard]] std::string table_text(const std::vector<std::string>& entries);

} // namespace hapnet::emulator

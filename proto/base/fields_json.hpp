// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace hapnet::base {

// Values as JSON, by the description of their fields (fields.hpp). Numbers are bare: the keys name
// their units. A number that is not finite, and an optional without a value, is null.

/// For types of one's own, beside them: overloads of json_of(value) and read_json(json, value).

[[nodiscard]] inline nlohmann::ordered_json json_of(double value)
{
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}
[[nodiscard]] inline nlohmann::ordered_json json_of(const std::string& value) { return value; }
[[nodiscard]] inline nlohmann::ordered_json json_of(bool value) { return value; }

template <std::integral T>
[[nodiscard]] nlohmann::ordered_json json_of(T value)
{
    return value;
}

template <Named Enum>
[[nodiscard]] nlohmann::ordered_json json_of(Enum value)
{
    return std::string{name_of(value)};
}

template <Described T>
[[nodiscard]] nlohmann::ordered_json json_of(const T& value);

template <typename T>
[[nodiscard]] nlohmann::ordered_json json_of(const std::optional<T>& value)
{
    return value ? json_of(*value) : nlohmann::ordered_json();
}

template <typename T>
[[nodiscard]] nlohmann::ordered_json json_of(const std::vector<T>& values);
template <typename T, std::size_t count>
[[nodiscard]] nlohmann::ordered_json json_of(const std::array<T, count>& values);

namespace detail {

template <typename List>
[[nodiscard]] nlohmann::ordered_json json_list(const List& values)
{
    auto list = nlohmann::ordered_json::array();
    for (const auto& value : values) list.push_back(json_of(value));
    return list;
}

} // namespace detail

template <typename T>
nlohmann::ordered_json json_of(const std::vector<T>& values)
{
    return detail::json_list(values);
}

template <typename T, std::size_t count>
nlohmann::ordered_json json_of(const std::array<T, count>& values)
{
    return detail::json_list(values);
}

/// An object with the fields' keys, in their order.
template <Described T>
nlohmann::ordered_json json_of(const T& value)
{
    auto object = nlohmann::ordered_json::object();
    for_each_field([&](const auto& field,
                       const auto& member) { object[std::string{field.key}] = json_of(member); },
                   value);
    return object;
}

// Reading: false when the JSON is something else; the target is then of no use.

inline bool read_json(const nlohmann::json& json, double& value)
{
    if (!json.is_number()) return false;
    value = json.get<double>();
    return true;
}

inline bool read_json(const nlohmann::json& json, std::string& value)
{
    if (!json.is_string()) return false;
    value = json.get<std::string>();
    return true;
}

inline bool read_json(const nlohmann::json& json, bool& value)
{
    if (!json.is_boolean()) return false;
    value = json.get<bool>();
    return true;
}

template <std::unsigned_integral T>
bool read_json(const nlohmann::json& json, T& value)
{
    if (!json.is_number_integer() || json < 0) return false;
    const auto read = json.get<std::uint64_t>();
    if (read > std::numeric_limits<T>::max()) return false;
    value = static_cast<T>(read);
    return true;
}

template <Named Enum>
bool read_json(const nlohmann::json& json, Enum& value)
{
    if (!json.is_string()) return false;
    const auto found = named<Enum>(json.get_ref<const std::string&>());
    if (found) value = *found;
    return found.has_value();
}

template <Described T>
bool read_json(const nlohmann::json& json, T& value);

template <typename T>
bool read_json(const nlohmann::json& json, std::optional<T>& value)
{
    value.reset();
    return json.is_null() || read_json(json, value.emplace());
}

template <typename T, std::size_t count>
bool read_json(const nlohmann::json& json, std::array<T, count>& values)
{
    if (!json.is_array() || json.size() != count) return false;
    for (std::size_t i = 0; i < count; ++i) {
        if (!read_json(json[i], values[i])) return false;
    }
    return true;
}

template <typename T>
bool read_json(const nlohmann::json& json, std::vector<T>& values)
{
    if (!json.is_array()) return false;
    values.clear();
    for (const auto& element : json) {
        if (!read_json(element, values.emplace_back())) return false;
    }
    return true;
}

/// All keys have to be there; others are passed over.
template <Described T>
bool read_json(const nlohmann::json& json, T& value)
{
    if (!json.is_object()) return false;
    bool is_good = true;
    for_each_field(
        [&](const auto& field, auto& member) {
            const auto found = json.find(std::string{field.key});
            is_good = is_good && found != json.end() && read_json(*found, member);
        },
        value);
    return is_good;
}

/// The value in `json`; an optional may be missing. The error names the first key that is missing
/// or of another kind.
template <Described T>
[[nodiscard]] Result<T> from_json(const nlohmann::json& json, const std::string& source)
{
    if (!json.is_object()) return fail(source + ": expected a JSON object");
    T value{};
    std::string_view wrong;
    for_each_field(
        [&](const auto& field, auto& member) {
            using Member = std::remove_cvref_t<decltype(member)>;
            const auto found = json.find(std::string{field.key});
            if (detail::is_optional<Member> && found == json.end()) return;
            const bool is_good = found != json.end() && read_json(*found, member);
            if (!is_good && wrong.empty()) wrong = field.key;
        },
        value);
    if (!wrong.empty()) return fail(fmt::format("{}: missing or wrong key '{}'", source, wrong));
    return value;
}

} // namespace hapnet::base

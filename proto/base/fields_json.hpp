// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"
#include "proto/base/result.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace hapnet::base {

// Values as JSON, by the description of their fields (fields.hpp). Numbers have no unit, because
// the keys name it. A number that is not finite and an optional without a value become null.

/// The way in which numbers below a key are written.
struct JsonScale {
    double ns_per_unit = 0.0; // unit of times, in ns; 0: no key has named a unit
    std::optional<int> decimals{};
    bool leaves_out_zeros = false; // maps leave out elements that are 0
};

[[nodiscard]] nlohmann::ordered_json json_of(const ValueKind& kind, const void* value,
                                             const JsonScale& scale = {});
/// Adds the keys of a struct to an object.
void add_json(nlohmann::ordered_json& object, const FieldTable& fields, const void* value,
              const JsonScale& scale = {});

/// Reads a value. Returns false if the JSON does not fit; the value is then unspecified.
[[nodiscard]] bool read_json(const ValueKind& kind, const nlohmann::json& json, void* value);
[[nodiscard]] Result<void> read_json(const FieldTable& fields, const nlohmann::json& json,
                                     const std::string& source, void* value);

/// Returns a struct as an object, with the keys of its fields in their order.
template <typename T>
[[nodiscard]] nlohmann::ordered_json json_of(const T& value)
{
    return json_of(kind_of<T>(), &value);
}

/// Reads a value. Returns false if the JSON does not fit; the value is then unspecified. All keys
/// of a struct are required; other keys are ignored.
template <typename T>
[[nodiscard]] bool read_json(const nlohmann::json& json, T& value)
{
    return read_json(kind_of<T>(), json, &value);
}

/// Returns the value in `json`. Only optionals may be missing. The error names the first key that
/// is missing or has the wrong type.
template <Described T>
[[nodiscard]] Result<T> from_json(const nlohmann::json& json, const std::string& source)
{
    T value{};
    if (const auto read = read_json(field_table<T>(), json, source, &value); !read) {
        return tl::unexpected{read.error()};
    }
    return value;
}

} // namespace hapnet::base

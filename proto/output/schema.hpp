// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::output {

/// Returns the JSON Schema (draft 2020-12) of the objects that base::json_of() makes from a struct:
/// every key with its type, its range and its description. Keys that are always present are
/// required. Each nested struct is listed once under $defs, by its name. `title` says what the
/// document is.
[[nodiscard]] nlohmann::ordered_json schema_of(const base::FieldTable& fields,
                                               std::string_view title);

/// Returns the text of the schema, as the programs print it.
template <base::Described T>
[[nodiscard]] std::string schema_text(std::string_view title)
{
    return schema_of(base::field_table<T>(), title).dump(2) + '\n';
}

} // namespace hapnet::output

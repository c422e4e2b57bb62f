// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::output {

/// The JSON Schema (draft 2020-12) of what base::json_of() makes of a struct: every key with its
/// kind, its range, and the words about it. Keys that are always there are required. Structs in the
/// struct stand once each under $defs, by their names. `title`: what the document is.
[[nodiscard]] nlohmann::ordered_json schema_of(const base::FieldTable& fields,
                                               std::string_view title);

/// Returns the text of the schema, as the programs print it.
template <base::Described T>
[[nodiscard]] std::string schema_text(std::string_view title)
{
    return schema_of(base::field_table<T>(), title).dump(2) + '\n';
}

} // namespace hapnet::output

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <string>

namespace hapnet::output {

/// Returns a Markdown table of the keys in a program's output, with their meanings. A dot separates
/// the keys of nested objects. Keys without a description, such as quantiles, are listed in the row
/// of their object. An object whose keys all have descriptions gets a table of its own.
[[nodiscard]] std::string key_table(const base::FieldTable& fields);

template <base::Described T>
[[nodiscard]] std::string key_table()
{
    return key_table(base::field_table<T>());
}

} // namespace hapnet::output

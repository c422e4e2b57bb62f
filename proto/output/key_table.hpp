// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <string>

namespace hapnet::output {

/// The keys of what a program prints, and what they mean, as a table of Markdown. A dot leads into
/// an object. Keys without words of their own, such as quantiles, stand in the row of the object
/// that they are in; an object all of whose keys have words has a table of its own.
[[nodiscard]] std::string key_table(const base::FieldTable& fields);

template <base::Described T>
[[nodiscard]] std::string key_table()
{
    return key_table(base::field_table<T>());
}

} // namespace hapnet::output

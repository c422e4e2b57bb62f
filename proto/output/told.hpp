// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <string>

namespace hapnet::output {

/// The counts of a struct that people are told, in a row: "100 received, 99 delivered, 1 lost". See
/// base::Told.
[[nodiscard]] std::string told(const base::FieldTable& fields, const void* value);

template <base::Described T>
[[nodiscard]] std::string told(const T& value)
{
    return told(base::field_table<T>(), &value);
}

} // namespace hapnet::output

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::output {

// Text for people about a struct. It contains the fields that have words for them, see base::Told.

/// Returns the counts as a list: "100 received, 99 delivered, 1 lost".
[[nodiscard]] std::string told(const base::FieldTable& fields, const void* value);

template <base::Described T>
[[nodiscard]] std::string told(const T& value)
{
    return told(base::field_table<T>(), &value);
}

/// A row of a table for people.
struct ToldFigure {
    std::string words; // such as "delay as drawn, mean (ms)"
    nlohmann::ordered_json value;
};

/// Returns a row for each figure in the JSON of a struct. A figure inside an object is named by the
/// words of the object and its own key.
[[nodiscard]] std::vector<ToldFigure> told_figures(const base::FieldTable& fields,
                                                   const nlohmann::ordered_json& json);

} // namespace hapnet::output

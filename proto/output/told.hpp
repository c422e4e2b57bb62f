// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::output {

// The text that people read about a struct: the fields with words for them, see base::Told.

/// The counts in a row: "100 received, 99 delivered, 1 lost".
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

/// Each figure in the JSON of a struct. Figures of an object have the object's words and their own
/// keys.
[[nodiscard]] std::vector<ToldFigure> told_figures(const base::FieldTable& fields,
                                                   const nlohmann::ordered_json& json);

} // namespace hapnet::output

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/analysis.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::lab {

/// An analysis for programs: units in the names, null where there is nothing to say.
[[nodiscard]] nlohmann::ordered_json to_json(const Analysis& analysis);

/// An analysis for people: lines of text.
[[nodiscard]] std::string to_table(const Analysis& analysis);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor/limits.hpp"
#include "proto/base/field_table.hpp"
#include "proto/base/result.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::device {

/// Returns the limits as TOML, for records. Infinite limits are left out. The mechanism of limited
/// joints must have a key.
[[nodiscard]] std::string print_limits(const GovernorLimits& limits);

/// Reads the output of print_limits(), and restores each value to the bit. `source` names the text
/// in errors, which begin with "SOURCE:LINE:COLUMN: ", or with "SOURCE: " when two keys contradict
/// each other. Values that would make a rule meaningless are refused, such as a ramp of no length.
/// Limits of joints must be for one of these mechanisms.
[[nodiscard]] base::Result<GovernorLimits> parse_limits(std::string_view text,
                                                        const std::string& source,
                                                        std::span<const Mechanism> mechanisms);

/// Returns the keys of that text except those of the joints, for the docs.
[[nodiscard]] std::vector<base::KeyRow> limit_keys();

} // namespace hapnet::device

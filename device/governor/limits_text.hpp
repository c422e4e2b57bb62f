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

/// Limits as TOML, for records; an infinite limit is left out. The mechanism of limited joints must
/// have a key.
[[nodiscard]] std::string print_limits(const GovernorLimits& limits);

/// Reads what print_limits() wrote, to the same bits. `source` names the text in errors, which
/// begin with "SOURCE:LINE:COLUMN: ", or with "SOURCE: " when two keys contradict each other.
/// Values that would make a rule meaningless are refused, such as a ramp of no length. Joints are
/// limited for one of these mechanisms.
[[nodiscard]] base::Result<GovernorLimits> parse_limits(std::string_view text,
                                                        const std::string& source,
                                                        std::span<const Mechanism> mechanisms);

/// The keys of that text except the joints', for the docs.
[[nodiscard]] std::vector<base::KeyRow> limit_keys();

} // namespace hapnet::device

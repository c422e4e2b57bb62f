// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor/limits.hpp"
#include "proto/base/result.hpp"

#include <string>
#include <string_view>

namespace hapnet::device {

/// Limits as TOML, for records: what has none is left out.
[[nodiscard]] std::string print_limits(const GovernorLimits& limits);

/// Reads what print_limits() wrote, to the same bits. `source` names the text in errors, which
/// begin with "SOURCE:LINE:COLUMN: ", or with "SOURCE: " where two keys contradict each other. What
/// would make a rule meaningless is refused, such as a ramp of no length. Limits of joints are
/// those of the PHANToM Omni's arm or of the Falcon's: of no other there is a Jacobian.
[[nodiscard]] base::Result<GovernorLimits> parse_limits(std::string_view text,
                                                        const std::string& source);

} // namespace hapnet::device

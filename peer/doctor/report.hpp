// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/doctor/findings.hpp"

#include <string>
#include <vector>

namespace hapnet::peer::doctor {

/// A line for each finding, and under it what to do.
[[nodiscard]] std::string finding_table(const std::vector<Finding>& findings);
[[nodiscard]] std::string finding_json(const std::vector<Finding>& findings);
[[nodiscard]] bool has_bad(const std::vector<Finding>& findings);

} // namespace hapnet::peer::doctor

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/run_statistics.hpp"
#include "proto/base/condition.hpp"
#include "proto/base/result.hpp"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace hapnet::emulator {

using Checks = std::vector<base::Condition>;

/// Returns an error that names the first check whose key does not exist in the statistics. Call it
/// before the run, so that a mistyped key does not show only after the run.
[[nodiscard]] base::Result<void> ensure_keys(const Checks& checks,
                                             const nlohmann::ordered_json& statistics);

[[nodiscard]] std::vector<CheckReport> judged(const Checks& checks,
                                              const nlohmann::ordered_json& statistics);

/// Returns a line for each check in the statistics that was not met: "NOT MET: up.received>=1000 is
/// required, and it is 42".
[[nodiscard]] std::string not_met(const nlohmann::ordered_json& statistics);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::lab {

/// Reads the files that scripts/real-time.sh has recorded in a folder and plays the same sessions
/// in virtual time. Writes real_time.csv and the entry in manifest.json there. Returns lines for a
/// person. Throws std::system_error when something cannot be written.
[[nodiscard]] base::Result<std::string> conclude_real_time(const RealTimeCommand& command);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

namespace hapnet::lab {

/// Reads the files that scripts/demo.sh has recorded in a folder, prints the table with the paper's
/// numbers and writes manifest.json and report.html. Returns true when the demo met its target.
/// Throws std::system_error when these files cannot be written.
[[nodiscard]] base::Result<bool> conclude_demo(const DemoReportCommand& command);

} // namespace hapnet::lab

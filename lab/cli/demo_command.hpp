// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

namespace hapnet::lab {

/// Reads what scripts/demo.sh has recorded in a folder, prints the table beside the paper's and
/// writes manifest.json and report.html. True when the demo met its target. Throws
/// std::system_error when these cannot be written.
[[nodiscard]] base::Result<bool> conclude_demo(const DemoReportCommand& command);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::lab {

/// Reads the result files of a folder and of its subfolders and writes report.html, figures/ and
/// gnuplot/ there. Gives the path of the page. Throws std::system_error when something cannot be
/// written.
[[nodiscard]] base::Result<std::string> write_report(const ReportCommand& command);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::lab {

/// Writes report.html and figures/: for a folder into that folder, for two records beside the first
/// one. Warns on standard error when it replaces a page about another subject. Returns the path of
/// the page. Fails when a file cannot be read, or when its folder's B2SUMS does not match it.
/// Throws std::system_error when something cannot be written.
[[nodiscard]] base::Result<std::string> write_report(const ReportCommand& command);

} // namespace hapnet::lab

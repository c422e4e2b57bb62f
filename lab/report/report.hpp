// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/file.hpp"
#include "lab/results/results.hpp"

#include <string_view>
#include <vector>

namespace hapnet::lab::report {

/// Returns the report of a result folder: report.html, and figures/*.csv for figures whose numbers
/// no result file has. Equal results give equal bytes.
[[nodiscard]] std::vector<results::File> report_of(const results::Results& results);

/// Returns the subject of a report.html: "experiments", "demo" or "session"; empty when the page
/// does not state it.
[[nodiscard]] std::string_view page_subject(std::string_view page);

} // namespace hapnet::lab::report

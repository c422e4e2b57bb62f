// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/file.hpp"
#include "lab/results/results.hpp"

#include <string_view>
#include <vector>

namespace hapnet::lab::report {

/// The report of a result folder: report.html, and figures/*.csv where no result file has the
/// numbers of a figure. Equal results give equal bytes.
[[nodiscard]] std::vector<results::File> report_of(const results::Results& results);

/// The subject of a report.html: "experiments", "demo" or "session"; empty when it does not say.
[[nodiscard]] std::string_view page_subject(std::string_view page);

} // namespace hapnet::lab::report

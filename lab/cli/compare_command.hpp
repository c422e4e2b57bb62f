// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::lab {

/// The differences between two folders of results, as a table, CSV or JSON. The error: one has no
/// sessions, or files that its B2SUMS does not match; or they have no sessions in common.
[[nodiscard]] base::Result<std::string> compare_folders(const CompareCommand& command);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::lab {

/// Returns the differences between two folders of results, as a table, CSV or JSON. Fails when a
/// folder has no sessions, when its B2SUMS does not match its files, or when the folders have no
/// sessions in common.
[[nodiscard]] base::Result<std::string> compare_folders(const CompareCommand& command);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/algorithm.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::peer::shared_object {

/// Opens the shared object of an algorithm that has one and is not loaded yet. Does nothing for any
/// other algorithm. The code in the file runs with all rights of this process. The error names the
/// file and says what is wrong with it.
[[nodiscard]] base::Result<void> load(Algorithm& algorithm);

/// Does the work of load_algorithm() with files from the disk, and then of load().
[[nodiscard]] base::Result<Algorithm> load_from_disk(const std::string& file_or_name);

} // namespace hapnet::peer::shared_object

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fates/fates.hpp"
#include "proto/base/result.hpp"

#include <string>

namespace hapnet::emulator {

/// Returns the fates in a file, by the names of their paths. The error names the file and the line.
[[nodiscard]] base::Result<FatesOfPaths> read_fates(const std::string& path);

} // namespace hapnet::emulator

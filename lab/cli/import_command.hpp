// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"
#include "proto/cli/command.hpp"

#include <string>

namespace hapnet::lab {

/// Adds `import hands` to the program; its options go to `import`.
cli::Command& add_import(cli::Command& program, ImportHandsCommand& import);

/// Writes scripts of recorded motion into the folder, and their trial into its manifest. Returns
/// what was done, in lines. The error: bad input. Throws std::system_error when a file cannot be
/// written.
[[nodiscard]] base::Result<std::string> import_files(const ImportHandsCommand& command);

} // namespace hapnet::lab

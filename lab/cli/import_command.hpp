// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "proto/base/result.hpp"
#include "proto/cli/command.hpp"

#include <string>

namespace hapnet::lab {

/// Adds `import hands` to the program. Its options are stored in `import`.
cli::Command& add_import(cli::Command& program, ImportHandsCommand& import);

/// Writes scripts of recorded motion into the folder, and adds their trial to its manifest. Returns
/// a report, in lines. Fails on bad input. Throws std::system_error when a file cannot be written.
[[nodiscard]] base::Result<std::string> import_files(const ImportHandsCommand& command);

} // namespace hapnet::lab

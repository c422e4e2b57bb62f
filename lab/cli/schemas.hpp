// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/schema_command.hpp"

#include <span>
#include <vector>

namespace hapnet::lab {

/// Returns the schemas of all documents that the program prints and writes.
[[nodiscard]] std::vector<cli::DocumentSchema> schemas();

/// Returns those schemas that are written by hand, in docs/formats/schemas.
[[nodiscard]] std::span<const cli::DocumentSchema> written_schemas();

} // namespace hapnet::lab

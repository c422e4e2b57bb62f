// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/schema_command.hpp"

#include <span>
#include <vector>

namespace hapnet::lab {

/// The schemas of all that the program prints and writes.
[[nodiscard]] std::vector<cli::DocumentSchema> schemas();

/// The part of them that is written by hand, in docs/formats/schemas.
[[nodiscard]] std::span<const cli::DocumentSchema> written_schemas();

} // namespace hapnet::lab

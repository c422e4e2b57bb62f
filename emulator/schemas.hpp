// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/schema_command.hpp"

#include <span>

namespace hapnet::emulator {

/// Those of docs/formats/schemas that are of this program's documents.
[[nodiscard]] std::span<const cli::DocumentSchema> written_schemas();

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/schema_command.hpp"

#include <span>

namespace hapnet::emulator {

/// The schemas in docs/formats/schemas of the documents that this program prints or writes.
[[nodiscard]] std::span<const cli::DocumentSchema> written_schemas();

} // namespace hapnet::emulator

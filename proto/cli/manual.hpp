// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/command.hpp"

#include <string>

namespace hapnet::cli {

/// Returns the manual page (section 1) of a program and its commands, in the format of scdoc(5).
[[nodiscard]] std::string manual(const Command& program);

} // namespace hapnet::cli

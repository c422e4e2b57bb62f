// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/cli/command.hpp"

#include <string>

namespace hapnet::cli {

/// The manual page of a program and its commands, section 1, as scdoc(5) takes it.
[[nodiscard]] std::string manual(const Command& program);

} // namespace hapnet::cli

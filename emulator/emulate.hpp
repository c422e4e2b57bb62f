// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace hapnet::emulator {

/// The program without a subcommand: relays until it is told to stop. Gives the exit code.
[[nodiscard]] int emulate(std::span<char*> words);

} // namespace hapnet::emulator

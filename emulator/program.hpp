// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace hapnet::emulator {

/// Runs hapnet-emulator. `words` are the words of the command line, the program's name first.
/// Returns the exit code; docs/use and --help list the codes.
int main_program(std::span<char*> words);

} // namespace hapnet::emulator

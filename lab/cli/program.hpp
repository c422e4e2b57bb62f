// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace hapnet::lab {

/// Runs hapnet-lab. `words` are the words of the command line, beginning with the program's name.
/// Returns the exit code; docs/use and --help list the exit codes.
int main_program(std::span<char*> words);

} // namespace hapnet::lab

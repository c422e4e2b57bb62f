// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace hapnet::peer {

/// Runs hapnet-peer. `words` are those of the command line, the program's name first. Returns the
/// exit code; docs/use and --help list them.
int main_program(std::span<char*> words);

} // namespace hapnet::peer

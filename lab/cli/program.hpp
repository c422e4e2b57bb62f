// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace hapnet::lab {

/// All of hapnet-lab but its main(). `words` are those of the command line, the program's name
/// first. The exit code: docs/use and --help say which there are.
int main_program(std::span<char*> words);

} // namespace hapnet::lab

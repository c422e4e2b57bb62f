// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

namespace hapnet::emulator {

/// `hapnet-emulator verify RUN`: whether the fates of a run are those that its profile promises.
/// `words` begin with "verify". Gives the exit code of the program: 1 when a test fails.
[[nodiscard]] int verify_program(std::span<char*> words);

} // namespace hapnet::emulator

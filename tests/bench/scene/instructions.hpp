// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/compare.hpp"

namespace hapnet::bench {

/// Counts the instructions of a step of the paper's scene by Valgrind, which runs this program
/// again with --spin. Returns no rows without Valgrind.
[[nodiscard]] std::vector<Row> count_instructions(std::span<const Subject> subjects);

/// Runs `steps` steps of the paper's scene, locked or not, at most 1300, in the program whose
/// instructions are counted. Returns false for an unknown subject.
bool spin(const std::string& subject, bool is_locked, int steps);

} // namespace hapnet::bench

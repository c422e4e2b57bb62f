// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/compare.hpp"

namespace hapnet::bench {

/// How many instructions a step of the paper's scene takes, counted by Valgrind, which runs this
/// program again with --spin; no rows without Valgrind.
[[nodiscard]] std::vector<Row> count_instructions(std::span<const Subject> subjects);

/// What the program that is counted does: `steps` steps of the paper's scene, locked or not, at
/// most 1300. False when there is no such subject.
bool spin(const std::string& subject, bool is_locked, int steps);

} // namespace hapnet::bench

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/subjects.hpp"

#include <string>
#include <vector>

namespace hapnet::bench {

/// The round trips of a probe through `between`, 40 ms each way. No rows, and a word on stderr,
/// where the system allows no network of one's own.
[[nodiscard]] std::vector<Row> measure_between(const Plan& plan);

/// The rows of what `probe --json` has printed behind whatever else; none when it has measured
/// nothing.
[[nodiscard]] std::vector<Row> rows_of_round_trips(const std::string& printed);

} // namespace hapnet::bench

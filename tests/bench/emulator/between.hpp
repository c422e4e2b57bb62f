// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/subjects.hpp"

#include <string>
#include <vector>

namespace hapnet::bench {

/// Measures the round trips of a probe through `between`, 40 ms each way. Returns no rows, with a
/// word on stderr, where the system allows no network namespace.
[[nodiscard]] std::vector<Row> measure_between(const Plan& plan);

/// Returns the rows of the output of `probe --json`, which may follow other output; none if the
/// probe measured nothing.
[[nodiscard]] std::vector<Row> rows_of_round_trips(const std::string& printed);

} // namespace hapnet::bench

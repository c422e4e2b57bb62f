// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"

#include <vector>

namespace hapnet::bench {

/// Measures the turn of one of 2 to 8 peers that carry a cube, with and without keys, and the cost
/// of each added peer; and the turn of one of two that share eight rotating bodies. The cases take
/// turns in `blocks` blocks of a thousand turns.
[[nodiscard]] std::vector<Row> measure_turns_of_many(int blocks);

} // namespace hapnet::bench

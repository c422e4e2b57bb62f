// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"

#include <vector>

namespace hapnet::bench {

/// What a turn of one of 2 to 8 peers takes that carry a cube, without keys and with, and what each
/// further peer adds; and a turn of one of two that share eight bodies, all of which turn. Each in
/// `blocks` blocks of a thousand turns in which the cases take turns.
[[nodiscard]] std::vector<Row> measure_turns_of_many(int blocks);

} // namespace hapnet::bench

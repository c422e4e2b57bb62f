// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"

#include <vector>

namespace hapnet::bench {

/// Measures the cost of keys for one side of a session: sealing and opening a state of the paper's
/// scene; a turn with a key beside one without, in `blocks` blocks of a thousand each; a forged
/// datagram that names a key in use; and a handshake, in total and in its longest tick.
[[nodiscard]] std::vector<Row> measure_costs_of_keys(int blocks);

} // namespace hapnet::bench

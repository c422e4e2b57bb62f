// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"

#include <vector>

namespace hapnet::bench {

/// What keys cost one side of a session: to seal and open a state of the paper's scene; a turn with
/// a key beside the same turn without, in turns of a thousand, `blocks` each; a forged datagram
/// that names a key in use; and a handshake, as a whole and in its longest tick.
[[nodiscard]] std::vector<Row> measure_costs_of_keys(int blocks);

} // namespace hapnet::bench

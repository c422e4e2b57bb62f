// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/subjects.hpp"

#include <vector>

namespace hapnet::bench {

/// Many paths in one emulator against one path with all of the traffic, in turn: how late the
/// datagrams of 64 clients and of 28 links are, at 1 kHz each, and what a datagram costs when two
/// threads relay and not one.
[[nodiscard]] std::vector<Row> measure_scale(const Plan& plan, bool fifo);

} // namespace hapnet::bench

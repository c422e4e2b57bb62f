// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/subjects.hpp"

#include <vector>

namespace hapnet::bench {

/// Measures the highest rate at which less than one datagram in a thousand is lost or left behind,
/// for this emulator and for the poll relay in turn, on one core each. With ordinary senders both
/// ends send and receive single datagrams. With offload they pass many at a time to the kernel and
/// receive them merged.
[[nodiscard]] std::vector<Row> measure_capacity(const Plan& plan, bool fifo);

} // namespace hapnet::bench

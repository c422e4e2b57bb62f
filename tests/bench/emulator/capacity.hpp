// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/subjects.hpp"

#include <vector>

namespace hapnet::bench {

/// The highest rate at which less than one datagram in a thousand is lost or left behind, of this
/// emulator and of the poll relay in turn, on one core each. With ordinary senders both ends send
/// and receive datagram by datagram; with offload they hand the kernel many at a time and get them
/// so.
[[nodiscard]] std::vector<Row> measure_capacity(const Plan& plan, bool fifo);

} // namespace hapnet::bench

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"

#include <vector>

namespace hapnet::bench {

/// The cost of a servo tick between the bytes of device and network, beside the same tick without
/// governor and kinematics. They take turns in `blocks` blocks of a thousand ticks each.
[[nodiscard]] std::vector<Row> measure_overhead(int blocks);

} // namespace hapnet::bench

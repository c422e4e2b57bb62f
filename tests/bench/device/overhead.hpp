// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/common/rows.hpp"

#include <vector>

namespace hapnet::bench {

/// What a tick of the servo costs between the device's bytes and the network's, beside the same
/// tick without governor and kinematics. They take turns in blocks of a thousand, `blocks` each.
[[nodiscard]] std::vector<Row> measure_overhead(int blocks);

} // namespace hapnet::bench

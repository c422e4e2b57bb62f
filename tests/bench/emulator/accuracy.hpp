// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "tests/bench/common/rows.hpp"
#include "tests/bench/emulator/subjects.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hapnet::bench {

/// The sorted errors of all datagrams of one subject, in the case that --csv prints.
struct Distribution {
    std::string_view subject;
    std::vector<base::Duration> errors;
};

struct Accuracy {
    std::vector<Row> rows;
    std::vector<Distribution> distributions; // at 1000 datagrams per second and 10 ms
};

/// Measures the error against the configured delay, of every subject and of the direct path. The
/// subjects take turns, round after round; each number is the median over the rounds.
[[nodiscard]] Accuracy measure_accuracy(const Plan& plan, bool fifo);

} // namespace hapnet::bench

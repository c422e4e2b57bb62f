// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/bench/scene/engine.hpp"

#include <span>

namespace hapnet::bench {

/// One point of a work-precision diagram: what an accuracy costs.
struct WorkPoint {
    std::string scenario;
    std::string metric; // of the error, with its unit
    std::string subject;
    double tick_ms = 1.0;
    double error = 0.0;
    double ns_per_simulated_ms = 0.0;
};

/// Error against cost over ticks of 4 to 0.25 ms, for every scenario with a known answer.
[[nodiscard]] std::vector<WorkPoint> measure_precision(std::span<const Subject> subjects,
                                                       bool is_quick);

/// One header line, one line for each point.
[[nodiscard]] std::string precision_csv(std::span<const WorkPoint> points);

/// A table in Markdown: for every scenario and subject the error at 1 ms, and its order in the tick
/// from 4 to 0.25 ms.
[[nodiscard]] std::string precision_markdown(std::span<const WorkPoint> points);

} // namespace hapnet::bench

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/device/overhead.hpp"

#include "tests/bench/common/timing.hpp"
#include "tests/bench/device/ticks.hpp"

namespace hapnet::bench {

namespace {

constexpr int turns_a_block = 1000;
constexpr double target_us = 10.0; // 1 % of a tick of 1 ms

} // namespace

std::vector<Row> measure_overhead(int blocks)
{
    Ticks governed{Load::governed};
    Ticks contact{Load::contact};
    std::vector<double> with;
    std::vector<double> without;
    for (int block = 0; block < blocks; ++block) {
        governed.play(turns_a_block, clock_ns, with);
        contact.play(turns_a_block, clock_ns, without);
    }
    const double clock = clock_cost_ns();
    std::vector<Row> rows;
    for (const auto& [metric, share] : {std::pair{"p50_us", 0.5}, std::pair{"p99_us", 0.99}}) {
        Row row{.name = "servo's tick, two hands on the cube",
                .subject = "governor, kinematics and contact",
                .baseline = "contact alone",
                .metric = metric,
                .value = 1e-3 * (quantile(with, share) - clock),
                .baseline_value = 1e-3 * (quantile(without, share) - clock),
                .target = std::nullopt};
        if (share == 0.5) row.target = target_us;
        rows.push_back(row);
    }
    return rows;
}

} // namespace hapnet::bench

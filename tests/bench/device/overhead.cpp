// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/device/overhead.hpp"

#include "proto/net/clock.hpp"
#include "tests/bench/device/ticks.hpp"

#include <algorithm>

namespace hapnet::bench {

namespace {

constexpr int turns_a_block = 1000;
constexpr double target_us = 10.0; // of a tick of 1000

std::int64_t clock_ns() { return net::monotonic_now().time_since_epoch().count(); }

/// What reading the clock twice costs: part of every tick's time, and none of it.
double clock_cost_ns()
{
    std::vector<double> costs;
    for (int i = 0; i < turns_a_block; ++i) {
        const std::int64_t begin = clock_ns();
        costs.push_back(static_cast<double>(clock_ns() - begin));
    }
    std::nth_element(costs.begin(), costs.begin() + turns_a_block / 2, costs.end());
    return costs[turns_a_block / 2];
}

double quantile(std::vector<double>& values, double share)
{
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

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

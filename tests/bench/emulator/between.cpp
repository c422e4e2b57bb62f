// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/emulator/between.hpp"

#include "tests/bench/emulator/machine.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

constexpr double round_trip_ms = 80.0;

} // namespace

std::vector<Row> rows_of_round_trips(const std::string& printed)
{
    const auto begin = printed.find('{');
    if (begin == std::string::npos) return {};
    const auto json = nlohmann::json::parse(printed.substr(begin), nullptr, false);
    const auto pointer = "/round_trip/delay_ms"_json_pointer;
    if (json.is_discarded() || !json.contains(pointer) || json.value("answered", 0) == 0) return {};
    const auto& delays = json[pointer];
    const auto row = [&](const char* quantile, double target) {
        return Row{.name = "between, 2 x 40 ms",
                   .subject = "probe",
                   .baseline = "",
                   .metric = fmt::format("{}_above_80ms_us", quantile),
                   .value = (delays.value(quantile, 0.0) - round_trip_ms) * 1000.0,
                   .baseline_value = std::nullopt,
                   .target = target};
    };
    std::vector<Row> rows{row("p50", 150.0), row("p99", 400.0), row("min", 0.0)};
    rows.back().direction = Direction::at_least;
    return rows;
}

std::vector<Row> measure_between(const Plan& plan)
{
    const char* count = plan.quick ? "200" : "1000";
    fmt::print(stderr, "between: {} round trips\n", count);
    auto rows = rows_of_round_trips(
        output_of({plan.emulator, "between", "--delay", "40ms", "--", plan.emulator, "probe",
                   "b:7002", "--count", count, "--rate", "200", "--json", "---", plan.emulator,
                   "probe", "--answer", "0.0.0.0:7002"}));
    if (rows.empty()) {
        fmt::print(stderr, "between: not measured: it does not run here; 'hapnet-emulator between "
                           "-- true --- true' says why\n");
    }
    return rows;
}

} // namespace hapnet::bench

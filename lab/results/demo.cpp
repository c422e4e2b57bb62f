// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/demo.hpp"

#include "proto/base/version.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::lab {

namespace {

using Json = nlohmann::ordered_json;

// The paper's Table 1, column "No Time Delay Compensation", in mm.
constexpr double paper_mean = 13.79;
constexpr double paper_min = 0.0;
constexpr double paper_max = 46.01;
constexpr double paper_std = 10.99;
constexpr double mean_tolerance = 0.15; // of the paper's mean

constexpr double delay_ms = 160.0;
constexpr double delay_tolerance_ms = 1.0;
constexpr double messages_per_s = 1000.0;
constexpr double messages_tolerance_per_s = 5.0;

constexpr std::array<std::string_view, 2> ways{"up", "down"};

/// The number at a JSON pointer, if there is one.
std::optional<double> number(const Json& json, const std::string& where)
{
    const Json::json_pointer pointer{where};
    if (!json.contains(pointer) || !json[pointer].is_number()) return std::nullopt;
    return json[pointer].get<double>();
}

std::string text(std::optional<double> value, int decimals)
{
    return value ? fmt::format("{:.{}f}", *value, decimals) : std::string{"-"};
}

bool is_near(std::optional<double> value, double wanted, double tolerance)
{
    return value && std::abs(*value - wanted) <= tolerance;
}

bool mean_is_met(const DemoRun& run)
{
    return is_near(number(run.p1.analysis, "/discrepancy_x_mm/mean"), paper_mean,
                   mean_tolerance * paper_mean);
}

/// received + duplicated = delivered + the sum of dropped + in_flight.
bool accounts_for_all(const Json& direction)
{
    const auto count = [&](const char* key) { return number(direction, key); };
    const auto received = count("/received"), duplicated = count("/duplicated");
    const auto delivered = count("/delivered"), in_flight = count("/in_flight");
    if (!received || !duplicated || !delivered || !in_flight) return false;
    double dropped = 0.0;
    for (const auto& cause : direction.value("dropped", Json::object())) {
        dropped += cause.get<double>();
    }
    return *received + *duplicated == *delivered + dropped + *in_flight;
}

bool accounts_for_all(const DemoTask& task)
{
    return accounts_for_all(task.emulator.value("up", Json::object())) &&
           accounts_for_all(task.emulator.value("down", Json::object()));
}

std::string against_paper(const DemoRun& run)
{
    const auto measured = [&](const std::string& key, int decimals = 2) {
        return text(number(run.p1.analysis, "/discrepancy_x_mm/" + key), decimals);
    };
    std::string out = "Table 1 of the paper, \"No Time Delay Compensation\", and task P1 here\n";
    constexpr auto row = "{:<28}{:>9}{:>9}{:>9}{:>9}\n";
    out += fmt::format(row, "|x_A - x_B|, mm", "mean", "min", "max", "std");
    out += fmt::format(row, "paper", text(paper_mean, 2), text(paper_min, 2), text(paper_max, 2),
                       text(paper_std, 2));
    out += fmt::format(row, "this run", measured("mean"), measured("min"), measured("max"),
                       measured("std"));
    out += fmt::format("mean within {:.0f} % of the paper's: {}\n", 100 * mean_tolerance,
                       mean_is_met(run) ? "met" : "MISSED");
    out += "The hands are simulated, and P1's path is calibrated: fitted to this very column.\n";
    return out;
}

/// One row of the table of both tasks: a number of each and what it should be.
struct Row {
    std::string_view title;
    std::string pointer;
    int decimals;
    std::optional<double> wanted{};
    double tolerance = 0.0;
};

std::string line(const Row& row, const Json& p1, const Json& t3)
{
    const auto a = number(p1, row.pointer), b = number(t3, row.pointer);
    std::string wanted;
    if (row.wanted) {
        const bool met =
            is_near(a, *row.wanted, row.tolerance) && is_near(b, *row.wanted, row.tolerance);
        wanted = fmt::format("   {:.0f} +- {:.0f}: {}", *row.wanted, row.tolerance,
                             met ? "met" : "MISSED");
    }
    return fmt::format("{:<28}{:>9}{:>9}{}\n", row.title, text(a, row.decimals),
                       text(b, row.decimals), wanted);
}

std::string both_tasks(const DemoRun& run)
{
    std::string out = fmt::format("{:<28}{:>9}{:>9}\n", "both tasks", "P1", "T3");
    for (const Row& row : {
             Row{"cubes apart, mean, mm", "/discrepancy_x_mm/mean", 2},
             Row{"cubes apart, max, mm", "/discrepancy_x_mm/max", 2},
             Row{"forces apart, mean, N", "/force_discrepancy_n/mean", 3},
             Row{"forces apart, max, N", "/force_discrepancy_n/max", 3},
             Row{"delay A to B, p50, ms", "/a_to_b/delay_ms/p50", 3, delay_ms, delay_tolerance_ms},
             Row{"delay B to A, p50, ms", "/b_to_a/delay_ms/p50", 3, delay_ms, delay_tolerance_ms},
             Row{"messages A to B, 1/s", "/a_to_b/packets_per_s", 1, messages_per_s,
                 messages_tolerance_per_s},
             Row{"messages B to A, 1/s", "/b_to_a/packets_per_s", 1, messages_per_s,
                 messages_tolerance_per_s},
         }) {
        out += line(row, run.p1.analysis, run.t3.analysis);
    }
    for (const std::string_view way : ways) {
        const auto title = fmt::format("emulator {} late, p99, us", way);
        out += line({title, fmt::format("/{}/lateness_us/p99", way), 1}, run.p1.emulator,
                    run.t3.emulator);
    }
    const auto accounted = [](const DemoTask& task) {
        return accounts_for_all(task) ? "all" : "NOT ALL";
    };
    out +=
        fmt::format("{:<28}{:>9}{:>9}   received + duplicated = delivered + dropped + in flight\n",
                    "datagrams accounted for", accounted(run.p1), accounted(run.t3));
    return out;
}

/// Why the run's own timing makes it worth nothing; empty: it does not.
Json invalid_because(const DemoRun& run)
{
    Json reasons = Json::array();
    const auto add = [&](std::string_view name, const DemoTask& task) {
        for (const auto& reason : task.analysis.value("invalid_because", Json::array())) {
            reasons.push_back(fmt::format("{}: {}", name, reason.get<std::string>()));
        }
        if (!task.emulator.value("valid", false)) {
            reasons.push_back(fmt::format("{}: the emulator was later than its budget", name));
        }
    };
    add("P1", run.p1);
    add("T3", run.t3);
    return reasons;
}

Json configuration_of(const DemoTask& task)
{
    Json configuration;
    for (const char* key : {"task", "duration_s", "algorithm", "scene", "device"}) {
        configuration[key] = task.peer.value(key, Json{});
    }
    configuration["emulator"] = task.emulator.value("configuration", Json{});
    return configuration;
}

} // namespace

std::string demo_table(const DemoRun& run)
{
    auto out = against_paper(run) + '\n' + both_tasks(run) + '\n';
    const Json reasons = invalid_because(run);
    if (reasons.empty()) return out + "The run is valid: its own timing kept its budget.\n";
    out += "The run is NOT VALID; its numbers say more about this machine than about Hapnet:\n";
    for (const auto& reason : reasons) out += "  " + reason.get<std::string>() + '\n';
    return out;
}

bool demo_is_met(const DemoRun& run)
{
    return mean_is_met(run) && accounts_for_all(run.p1) && accounts_for_all(run.t3);
}

Json demo_manifest(const DemoRun& run, const DemoCircumstances& circumstances)
{
    const Json reasons = invalid_because(run);
    return {{"command", circumstances.command},
            {"configuration", {{"p1", configuration_of(run.p1)}, {"t3", configuration_of(run.t3)}}},
            {"seeds",
             {{"peers", run.p1.peer.value("seed", Json{})},
              {"emulator", run.p1.emulator.value("seed", Json{})}}},
            {"version", base::version()},
            {"commit", base::commit()},
            {"compiler", base::compiler()},
            {"host", circumstances.host},
            {"start", circumstances.start},
            {"wall_time_s", circumstances.wall_time_s},
            {"met", demo_is_met(run)},
            {"valid", reasons.empty()},
            {"invalid_because", reasons}};
}

} // namespace hapnet::lab

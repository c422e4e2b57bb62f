// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/demo.hpp"

#include "lab/results/paper.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>

namespace hapnet::lab::results {

namespace {

using Json = nlohmann::ordered_json;

constexpr double paper_min_mm = 0.0;
constexpr double mean_tolerance = 0.15; // share of the paper's mean

/// Column "No Time Delay Compensation" of the paper's Table 1.
PaperRow paper_row() { return paper_table1("base").value(); }

constexpr double delay_ms = 160.0;
constexpr double delay_tolerance_ms = 1.0;
constexpr double messages_per_s = 1000.0;
constexpr double messages_tolerance_per_s = 5.0;

constexpr std::size_t cell_width = 9; // characters per cell in a terminal

constexpr std::array<std::string_view, 2> ways{"up", "down"};

/// Returns the number at a JSON pointer, if there is one.
std::optional<double> number(const Json& json, const std::string& where)
{
    const Json::json_pointer pointer{where};
    if (!json.contains(pointer) || !json[pointer].is_number()) return std::nullopt;
    return json[pointer].get<double>();
}

bool is_near(std::optional<double> value, double wanted, double tolerance)
{
    return value && std::abs(*value - wanted) <= tolerance;
}

bool mean_is_met(const DemoRun& run)
{
    const double mean_mm = paper_row().mean_mm;
    return is_near(number(run.p1.analysis, "/discrepancy_x_mm/mean"), mean_mm,
                   mean_tolerance * mean_mm);
}

/// True if received + duplicated = delivered + the sum of dropped + in_flight.
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

bool accounts_for_all(const SessionFiles& task)
{
    return accounts_for_all(task.emulator.value("up", Json::object())) &&
           accounts_for_all(task.emulator.value("down", Json::object()));
}

records::TextTable against_paper(const DemoRun& run)
{
    const auto measured = [&](const std::string& key) {
        return records::number_text(number(run.p1.analysis, "/discrepancy_x_mm/" + key), 2);
    };
    const auto shown = [](double value) { return records::number_text(value, 2); };
    const PaperRow paper = paper_row();
    return {
        "Table 1 of the paper, \"No Time Delay Compensation\", and task P1 here",
        "|x_A - x_B|, mm",
        {"mean", "min", "max", "std"},
        {{"paper",
          {shown(paper.mean_mm), shown(paper_min_mm), shown(paper.max_mm), shown(paper.std_mm)}},
         {"this run", {measured("mean"), measured("min"), measured("max"), measured("std")}}},
        {fmt::format("mean within {:.0f} % of the paper's: {}", 100 * mean_tolerance,
                     mean_is_met(run) ? "met" : "MISSED"),
         "The hands are simulated, and P1's path is calibrated: fitted to this very column."},
        cell_width};
}

/// A number of a task's analysis, with its accepted value if there is one.
struct Quantity {
    std::string name;
    std::string pointer;
    int decimals;
    std::optional<double> wanted{};
    double tolerance = 0.0;
};

std::vector<Quantity> quantities()
{
    return {
        {"cubes apart, mean, mm", "/discrepancy_x_mm/mean", 2},
        {"cubes apart, max, mm", "/discrepancy_x_mm/max", 2},
        {"forces apart, mean, N", "/force_discrepancy_n/mean", 3},
        {"forces apart, max, N", "/force_discrepancy_n/max", 3},
        {"delay A to B, p50, ms", "/a_to_b/delay_ms/p50", 3, delay_ms, delay_tolerance_ms},
        {"delay B to A, p50, ms", "/b_to_a/delay_ms/p50", 3, delay_ms, delay_tolerance_ms},
        {"messages A to B, 1/s", "/a_to_b/packets_per_s", 1, messages_per_s,
         messages_tolerance_per_s},
        {"messages B to A, 1/s", "/b_to_a/packets_per_s", 1, messages_per_s,
         messages_tolerance_per_s},
    };
}

/// True if both tasks meet the quantity, or it has no accepted value.
bool is_met(const Quantity& quantity, const DemoRun& run)
{
    if (!quantity.wanted) return true;
    const auto meets = [&](const SessionFiles& task) {
        return is_near(number(task.analysis, quantity.pointer), *quantity.wanted,
                       quantity.tolerance);
    };
    return meets(run.p1) && meets(run.t3);
}

records::TextTable::Row row_of(const Quantity& quantity, const Json& p1, const Json& t3)
{
    return {quantity.name,
            {records::number_text(number(p1, quantity.pointer), quantity.decimals),
             records::number_text(number(t3, quantity.pointer), quantity.decimals)}};
}

records::TextTable both_tasks(const DemoRun& run)
{
    records::TextTable table{"Both tasks", "both tasks", {"P1", "T3"}, {}, {}, cell_width};
    for (const Quantity& quantity : quantities()) {
        auto& row = table.rows.emplace_back(row_of(quantity, run.p1.analysis, run.t3.analysis));
        if (!quantity.wanted) continue;
        row.note = fmt::format("{:.0f} +- {:.0f}: {}", *quantity.wanted, quantity.tolerance,
                               is_met(quantity, run) ? "met" : "MISSED");
    }
    for (const std::string_view way : ways) {
        table.rows.push_back(row_of({fmt::format("emulator {} late, p99, us", way),
                                     fmt::format("/{}/lateness_us/p99", way), 1},
                                    run.p1.emulator, run.t3.emulator));
    }
    const auto accounted = [](const SessionFiles& task) {
        return accounts_for_all(task) ? "all" : "NOT ALL";
    };
    table.rows.push_back({"datagrams accounted for",
                          {accounted(run.p1), accounted(run.t3)},
                          "received + duplicated = delivered + dropped + in flight"});
    return table;
}

/// Returns the reasons why the run does not count; empty: it does.
std::vector<std::string> invalid_because(const DemoRun& run)
{
    std::vector<std::string> reasons;
    for (const auto& [name, task] : {std::pair{"P1", &run.p1}, {"T3", &run.t3}}) {
        for (const std::string& reason : task->invalid_because()) {
            reasons.push_back(fmt::format("{}: {}", name, reason));
        }
    }
    return reasons;
}

std::string verdict_on(const std::vector<std::string>& reasons)
{
    if (reasons.empty()) return "The run is valid: it kept its own timing budget.\n";
    std::string out =
        "The run is NOT VALID; its numbers say more about this machine than about Hapnet:\n";
    for (const std::string& reason : reasons) out += "  " + reason + '\n';
    return out;
}

Json configuration_of(const SessionFiles& task)
{
    Json configuration;
    for (const char* key : {"task", "duration_s", "algorithm", "scene", "device"}) {
        configuration[key] = task.peer.value(key, Json{});
    }
    configuration["emulator"] = task.emulator.value("configuration_at_start", Json{});
    return configuration;
}

} // namespace

std::vector<records::TextTable> demo_tables(const DemoRun& run)
{
    return {against_paper(run), both_tasks(run)};
}

std::string demo_table(const DemoRun& run)
{
    const records::TextTable paper = against_paper(run);
    const auto out =
        fmt::format("{}\n{}\n{}\n", paper.caption, to_text(paper), to_text(both_tasks(run)));
    return out + verdict_on(invalid_because(run));
}

bool demo_is_met(const DemoRun& run)
{
    const auto rows = quantities();
    return mean_is_met(run) && accounts_for_all(run.p1) && accounts_for_all(run.t3) &&
           std::all_of(rows.begin(), rows.end(),
                       [&](const Quantity& quantity) { return is_met(quantity, run); });
}

bool demo_is_valid(const DemoRun& run) { return invalid_because(run).empty(); }

bool circle_demo_is_valid(const CircleDemo& demo) { return demo.files.invalid_because().empty(); }

std::string circle_demo_verdict(const CircleDemo& demo)
{
    return verdict_on(demo.files.invalid_because());
}

Json circle_demo_manifest(const CircleDemo& demo, const Circumstances& circumstances)
{
    const auto reasons = demo.files.invalid_because();
    const auto task = demo.files.peer.value("task", std::string{});
    Json peers = Json::array({demo.files.peer.value("peer_id", Json{})});
    for (const Json& other : demo.files.peer.value("others", Json::array())) {
        peers.push_back(other.value("id", Json{}));
    }
    Json configuration = configuration_of(demo.files);
    configuration["peers"] = peers;
    Json manifest = manifest_head(circumstances);
    manifest.update({{"kind", "demo"},
                     {"title", fmt::format("{} peers, one cube, task {}", peers.size(), task)},
                     {"configuration", {{demo.folder, std::move(configuration)}}},
                     {"seeds",
                      {{"peers", demo.files.peer.value("seed", Json{})},
                       {"emulator", demo.files.emulator.value("seed", Json{})}}},
                     {"valid", reasons.empty()},
                     {"invalid_because", reasons}});
    return manifest;
}

Json demo_manifest(const DemoRun& run, const Circumstances& circumstances)
{
    const auto reasons = invalid_because(run);
    Json manifest = manifest_head(circumstances);
    manifest.update(
        {{"kind", "demo"},
         {"title", "Two peers, one cube, 160 ms"},
         {"configuration", {{"p1", configuration_of(run.p1)}, {"t3", configuration_of(run.t3)}}},
         {"seeds",
          {{"peers", run.p1.peer.value("seed", Json{})},
           {"emulator", run.p1.emulator.value("seed", Json{})}}},
         {"met", demo_is_met(run)},
         {"valid", reasons.empty()},
         {"invalid_because", reasons}});
    return manifest;
}

} // namespace hapnet::lab::results

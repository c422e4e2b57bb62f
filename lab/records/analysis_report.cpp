// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/analysis_report.hpp"

#include "lab/records/bodies.hpp"
#include "proto/base/fields_json.hpp"

#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>

namespace hapnet::lab::records {

namespace {

double ms(base::Duration duration) { return 1e-6 * static_cast<double>(duration.count()); }
double us(base::Duration duration) { return 1e-3 * static_cast<double>(duration.count()); }

template <typename T>
std::optional<double> part(const std::optional<T>& whole, auto member, double unit)
{
    if (!whole) return std::nullopt;
    return unit * ((*whole).*member);
}

/// True if the bodies need more than the distances in x.
bool has_many_or_turning(const std::vector<BodyAgreement>& bodies)
{
    return bodies.size() > 1 || (bodies.size() == 1 && bodies.front().body.can_turn);
}

TextTable bodies_table(const std::vector<BodyAgreement>& bodies)
{
    TextTable table{"How far the copies of each body were apart at equal times",
                    "bodies",
                    {"mean, mm", "max, mm", "mean, deg", "max, deg", "settled, mm", "settled, deg",
                     "handovers"},
                    {},
                    {},
                    14};
    for (const BodyAgreement& one : bodies) {
        const auto& apart = one.discrepancy;
        const auto& turned = one.turned_apart;
        table.rows.push_back({name_of(one.body),
                              {number_text(part(apart, &metrics::Spread::mean, mm_per_m), 3),
                               number_text(part(apart, &metrics::Spread::max, mm_per_m), 3),
                               number_text(part(turned, &metrics::Spread::mean, deg_per_rad), 3),
                               number_text(part(turned, &metrics::Spread::max, deg_per_rad), 3),
                               number_text(scaled(one.settled_discrepancy, mm_per_m), 4),
                               number_text(scaled(one.settled_turned_apart, deg_per_rad), 4),
                               one.handovers ? std::to_string(*one.handovers) : "-"}});
    }
    return table;
}

TextTable distances_table(const Agreement& agreement)
{
    const auto& x = agreement.discrepancy_x;
    const auto of_x = [&](double metrics::Spread::*member) {
        return number_text(part(x, member, mm_per_m), 3);
    };
    const auto of_force = [](const std::optional<ForceDiscrepancy>& force,
                             double ForceDiscrepancy::*member) {
        return number_text(part(force, member, 1.0), 3);
    };
    const auto& bodies = agreement.bodies;
    const std::string who = bodies.size() == 1 ? name_of(bodies.front().body) : "farthest body";
    const auto& device = agreement.force_discrepancy;
    const auto& contact = agreement.contact_force_discrepancy;
    return {"How far both sides were apart at equal times",
            "",
            {"mean", "min", "max", "std"},
            {{who + " |x_A - x_B|, mm",
              {of_x(&metrics::Spread::mean), of_x(&metrics::Spread::min),
               of_x(&metrics::Spread::max), of_x(&metrics::Spread::std)}},
             {"force on hands ||F_A| - |F_B||, N",
              {of_force(device, &ForceDiscrepancy::mean), "",
               of_force(device, &ForceDiscrepancy::max), ""}},
             {"contact force, N",
              {of_force(contact, &ForceDiscrepancy::mean), "",
               of_force(contact, &ForceDiscrepancy::max), ""}},
             {agreement.settled_discrepancy ? "settled at the end, mm"
                                            : "settled at the end, mm (sessions above 4 s)",
              {"", "", number_text(scaled(agreement.settled_discrepancy, mm_per_m), 4), ""}}}};
}

TextTable touching_table(const Agreement& agreement)
{
    const TouchShares& touching = agreement.touching;
    const auto percent = [](double share) { return number_text(1e2 * share, 1); };
    const auto& bodies = agreement.bodies;
    const std::string what = bodies.size() == 1 ? named_in_text(bodies.front().body) : "a body";
    return {fmt::format("Who touched {}, and for how long both sides were in session", what),
            "",
            {"A", "B", "either", "both"},
            {{fmt::format("touching {}, %", what),
              {percent(touching.a), percent(touching.b), percent(touching.either),
               percent(touching.both)}},
             {"time compared, s", {"", "", "", number_text(base::to_seconds(agreement.scored), 3)}},
             {"overlap, %", {"", "", "", number_text(1e2 * agreement.overlap, 2)}}}};
}

TextTable network_table(const Path& up, const Path& down)
{
    TextTable table{"What the network did", "", {"A to B", "B to A"}, {}, {}, 12};
    const auto add = [&](std::string_view name, const auto& cell) {
        table.rows.push_back({std::string{name}, {cell(up), cell(down)}});
    };
    const auto count = [](std::uint64_t base::ArrivalCounts::*member) {
        return [=](const Path& path) { return std::to_string(path.arrived.*member); };
    };
    const auto time = [](std::optional<base::Quantiles> Path::*of,
                         base::Duration base::Quantiles::*member) {
        return [=](const Path& path) {
            const auto& found = path.*of;
            return number_text(found ? std::optional{ms((*found).*member)} : std::nullopt, 3);
        };
    };
    add("sent", count(&base::ArrivalCounts::sent));
    add("received", count(&base::ArrivalCounts::received));
    add("lost", [](const Path& path) { return std::to_string(path.lost()); });
    add("in flight at the end", [](const Path& path) { return std::to_string(path.in_flight); });
    add("duplicates", count(&base::ArrivalCounts::duplicates));
    add("reordered", count(&base::ArrivalCounts::reordered));
    add("loss, %", [](const Path& path) { return number_text(scaled(path.loss, 1e2), 3); });
    add("sent per second", [](const Path& path) { return number_text(path.packets_per_s, 2); });
    add("delay p50, ms", time(&Path::delay, &base::Quantiles::p50));
    add("delay p99, ms", time(&Path::delay, &base::Quantiles::p99));
    add("delay max, ms", time(&Path::delay, &base::Quantiles::max));
    add("jitter p50, ms", time(&Path::jitter, &base::Quantiles::p50));
    add("jitter p99, ms", time(&Path::jitter, &base::Quantiles::p99));
    table.remarks = {
        "sent = received + lost + in flight at the end, which were sent after the last "
        "that came"};
    return table;
}

TextTable loops_table(const std::vector<std::pair<std::string, Loop>>& loops)
{
    TextTable table{"How well each haptic loop kept its time", "", {}, {}, {}, 12};
    for (const auto& [name, loop] : loops) table.heads.push_back(name);
    const auto add = [&](std::string name, const auto& cell) {
        TextTable::Row row{std::move(name), {}};
        for (const auto& [who, loop] : loops) row.cells.push_back(cell(loop));
        table.rows.push_back(std::move(row));
    };
    add("ticks per second", [](const Loop& loop) { return number_text(loop.rate_hz, 2); });
    add("ticks missed", [](const Loop& loop) { return std::to_string(loop.missed); });
    for (const auto& [name, member] : {std::pair{"late p50, us", &base::Quantiles::p50},
                                       {"late p99, us", &base::Quantiles::p99},
                                       {"late max, us", &base::Quantiles::max}}) {
        add(name, [member = member](const Loop& loop) {
            return number_text(loop.late ? std::optional{us((*loop.late).*member)} : std::nullopt,
                               3);
        });
    }
    return table;
}

TextTable pairs_table(const std::vector<PairAnalysis>& pairs)
{
    TextTable table{"How far every two were apart at equal times",
                    "copies",
                    {"mean, mm", "max, mm", "std, mm", "settled, mm", "overlap, %"},
                    {},
                    {},
                    12};
    for (const PairAnalysis& pair : pairs) {
        const Agreement& agreement = pair.analysis.agreement;
        const auto x = [&](double metrics::Spread::*member) {
            return number_text(part(agreement.discrepancy_x, member, mm_per_m), 3);
        };
        table.rows.push_back(
            {fmt::format("|x_{} - x_{}|", pair.id_a, pair.id_b),
             {x(&metrics::Spread::mean), x(&metrics::Spread::max), x(&metrics::Spread::std),
              number_text(scaled(agreement.settled_discrepancy, mm_per_m), 4),
              number_text(1e2 * agreement.overlap, 2)}});
    }
    return table;
}

TextTable ways_table(const std::vector<PairAnalysis>& pairs)
{
    TextTable table{"What the network did",
                    "",
                    {"received", "loss, %", "delay p50, ms", "delay p99, ms", "jitter p99, ms"},
                    {},
                    {},
                    15};
    const auto add = [&](std::int64_t from, std::int64_t to, const Path& path) {
        const auto time = [](const std::optional<base::Quantiles>& times,
                             base::Duration base::Quantiles::*member) {
            return number_text(times ? std::optional{ms((*times).*member)} : std::nullopt, 3);
        };
        table.rows.push_back(
            {fmt::format("{} to {}", from, to),
             {std::to_string(path.arrived.received), number_text(scaled(path.loss, 1e2), 3),
              time(path.delay, &base::Quantiles::p50), time(path.delay, &base::Quantiles::p99),
              time(path.jitter, &base::Quantiles::p99)}});
    };
    for (const PairAnalysis& pair : pairs) {
        add(pair.id_a, pair.id_b, pair.analysis.a_to_b);
        add(pair.id_b, pair.id_a, pair.analysis.b_to_a);
    }
    return table;
}

std::string verdict_text(const std::vector<std::string>& invalid_because)
{
    std::string text = invalid_because.empty() ? "valid\n" : "NOT VALID\n";
    for (const std::string& reason : invalid_because) text += "  " + reason + '\n';
    return text;
}

} // namespace

nlohmann::ordered_json to_json(const Analysis& analysis) { return base::json_of(analysis); }

std::vector<TextTable> tables_of(const Analysis& analysis)
{
    const Agreement& agreement = analysis.agreement;
    std::vector<TextTable> tables{distances_table(agreement)};
    if (has_many_or_turning(agreement.bodies)) tables.push_back(bodies_table(agreement.bodies));
    tables.push_back(touching_table(agreement));
    tables.push_back(network_table(analysis.a_to_b, analysis.b_to_a));
    tables.push_back(loops_table({{"A", analysis.a}, {"B", analysis.b}}));
    return tables;
}

std::string clock_text(const Clock& clock)
{
    if (clock.method == ClockMethod::same_boot) return "";
    if (clock.method == ClockMethod::synchronised)
        return fmt::format("two clocks that are synchronised within {:.3f} ms",
                           ms(clock.uncertainty));
    return fmt::format("two clocks: B is {:.3f} ms ahead of A, known within {:.3f} ms",
                       ms(clock.offset), ms(clock.uncertainty));
}

std::string to_table(const Analysis& analysis)
{
    std::string text;
    for (const TextTable& table : tables_of(analysis)) text += to_text(table) + '\n';
    if (const auto clock = clock_text(analysis.clock); !clock.empty()) text += clock + "\n\n";
    return text + verdict_text(analysis.invalid_because);
}

nlohmann::ordered_json to_json(const CircleAnalysis& circle)
{
    if (circle.pairs.empty()) return nlohmann::ordered_json::object();
    const PairAnalysis* worst = circle.worst();
    AnalysisReport report{.all = circle.pairs.front().analysis};
    Agreement& agreement = report.all.agreement;
    agreement.discrepancy_x.reset();
    report.worst_pair.emplace();
    if (worst != nullptr) {
        agreement.discrepancy_x = worst->analysis.agreement.discrepancy_x;
        *report.worst_pair = worst->name();
    }
    agreement.settled_discrepancy = circle.settled_discrepancy();
    agreement.settled_turned_apart = circle.settled_turned_apart();
    agreement.bodies = circle.bodies();
    report.all.invalid_because = circle.invalid_because;
    auto& pairs = report.pairs.emplace();
    for (const PairAnalysis& pair : circle.pairs) {
        pairs.emplace_back(pair.name(), PairReport{&pair.analysis});
    }
    auto& peers = report.peers.emplace();
    for (const auto& [id, loop] : circle.loops) {
        peers.emplace_back(std::to_string(id), LoopReport{loop});
    }
    return base::json_of(report);
}

std::vector<TextTable> tables_of(const CircleAnalysis& circle)
{
    std::vector<std::pair<std::string, Loop>> loops;
    for (const auto& [id, loop] : circle.loops)
        loops.emplace_back(fmt::format("peer {}", id), loop);
    std::vector<TextTable> tables{pairs_table(circle.pairs)};
    const auto bodies = circle.bodies();
    if (has_many_or_turning(bodies)) tables.push_back(bodies_table(bodies));
    tables.push_back(ways_table(circle.pairs));
    tables.push_back(loops_table(loops));
    return tables;
}

std::string to_table(const CircleAnalysis& circle)
{
    std::string text;
    for (const TextTable& table : tables_of(circle)) text += to_text(table) + '\n';
    for (const PairAnalysis& pair : circle.pairs) {
        if (const auto clock = clock_text(pair.analysis.clock); !clock.empty())
            text += fmt::format("{} (A-B): {}\n\n", pair.name(), clock);
    }
    return text + verdict_text(circle.invalid_because);
}

} // namespace hapnet::lab::records

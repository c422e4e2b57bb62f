// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/analysis_report.hpp"

#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>

namespace hapnet::lab::records {

namespace {

using Json = nlohmann::ordered_json;

constexpr double mm = 1e3; // metres into millimetres

double ms(base::Duration duration) { return 1e-6 * static_cast<double>(duration.count()); }
double us(base::Duration duration) { return 1e-3 * static_cast<double>(duration.count()); }

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(std::optional<double> value) { return value ? number(*value) : Json(nullptr); }

Json json_of(const std::optional<metrics::Spread>& spread)
{
    if (!spread) return nullptr;
    return {{"mean", number(mm * spread->mean)},
            {"min", number(mm * spread->min)},
            {"max", number(mm * spread->max)},
            {"std", number(mm * spread->std)}};
}

Json json_of(const std::optional<ForceDiscrepancy>& force)
{
    if (!force) return nullptr;
    return {{"mean", number(force->mean)}, {"max", number(force->max)}};
}

Json json_of(const std::optional<metrics::Quantiles>& quantiles, double (*unit)(base::Duration))
{
    if (!quantiles) return nullptr;
    return {{"p50", unit(quantiles->p50)},
            {"p99", unit(quantiles->p99)},
            {"max", unit(quantiles->max)}};
}

Json json_of(const Path& path)
{
    return {{"sent", path.sent},
            {"received", path.received},
            {"duplicates", path.duplicates},
            {"reordered", path.reordered},
            {"loss", number(path.loss)},
            {"packets_per_s", number(path.packets_per_s)},
            {"delay_ms", json_of(path.delay, ms)},
            {"jitter_ms", json_of(path.jitter, ms)}};
}

Json json_of(const Loop& loop)
{
    return {{"tick",
             {{"rate_hz", number(loop.rate_hz)},
              {"missed", loop.missed},
              {"late_us", json_of(loop.late, us)}}}};
}

constexpr std::string_view name_of(ClockMethod method)
{
    return method == ClockMethod::same_boot ? "same-boot" : "echo";
}

template <typename T>
std::optional<double> part(const std::optional<T>& whole, auto member, double unit)
{
    if (!whole) return std::nullopt;
    return unit * ((*whole).*member);
}

std::optional<double> scaled(std::optional<double> value, double unit)
{
    return value ? std::optional{unit * *value} : std::nullopt;
}

TextTable distances_table(const Agreement& agreement)
{
    const auto& x = agreement.discrepancy_x;
    const auto& force = agreement.force_discrepancy;
    const auto of_x = [&](double metrics::Spread::*member) {
        return number_text(part(x, member, mm), 3);
    };
    const auto of_force = [&](double ForceDiscrepancy::*member) {
        return number_text(part(force, member, 1.0), 3);
    };
    return {"How far both sides were apart at equal times",
            "",
            {"mean", "min", "max", "std"},
            {{"cube |x_A - x_B|, mm",
              {of_x(&metrics::Spread::mean), of_x(&metrics::Spread::min),
               of_x(&metrics::Spread::max), of_x(&metrics::Spread::std)}},
             {"force ||F_A| - |F_B||, N",
              {of_force(&ForceDiscrepancy::mean), "", of_force(&ForceDiscrepancy::max), ""}},
             {agreement.settled_discrepancy ? "settled at the end, mm"
                                            : "settled at the end, mm (sessions above 4 s)",
              {"", "", number_text(scaled(agreement.settled_discrepancy, mm), 4), ""}}}};
}

TextTable touching_table(const Agreement& agreement)
{
    const TouchShares& touching = agreement.touching;
    const auto percent = [](double share) { return number_text(1e2 * share, 1); };
    return {"Who touched the cube, and for how long both sides were in session",
            "",
            {"A", "B", "either", "both"},
            {{"touching the cube, %",
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
    const auto count = [](std::uint64_t Path::*member) {
        return [=](const Path& path) { return std::to_string(path.*member); };
    };
    const auto time = [](std::optional<metrics::Quantiles> Path::*of,
                         base::Duration metrics::Quantiles::*member) {
        return [=](const Path& path) {
            const auto& found = path.*of;
            return number_text(found ? std::optional{ms((*found).*member)} : std::nullopt, 3);
        };
    };
    add("sent", count(&Path::sent));
    add("received", count(&Path::received));
    add("duplicates", count(&Path::duplicates));
    add("reordered", count(&Path::reordered));
    add("loss, %", [](const Path& path) { return number_text(scaled(path.loss, 1e2), 3); });
    add("sent per second", [](const Path& path) { return number_text(path.packets_per_s, 2); });
    add("delay p50, ms", time(&Path::delay, &metrics::Quantiles::p50));
    add("delay p99, ms", time(&Path::delay, &metrics::Quantiles::p99));
    add("delay max, ms", time(&Path::delay, &metrics::Quantiles::max));
    add("jitter p50, ms", time(&Path::jitter, &metrics::Quantiles::p50));
    add("jitter p99, ms", time(&Path::jitter, &metrics::Quantiles::p99));
    return table;
}

TextTable loops_table(const Loop& a, const Loop& b)
{
    const auto late = [](const Loop& loop, base::Duration metrics::Quantiles::*member) {
        return number_text(loop.late ? std::optional{us((*loop.late).*member)} : std::nullopt, 3);
    };
    TextTable table{"How well each haptic loop kept its time", "", {"A", "B"}, {}, {}, 12};
    table.rows = {{"ticks per second", {number_text(a.rate_hz, 2), number_text(b.rate_hz, 2)}},
                  {"ticks missed", {std::to_string(a.missed), std::to_string(b.missed)}}};
    for (const auto& [name, member] : {std::pair{"late p50, us", &metrics::Quantiles::p50},
                                       {"late p99, us", &metrics::Quantiles::p99},
                                       {"late max, us", &metrics::Quantiles::max}}) {
        table.rows.push_back({name, {late(a, member), late(b, member)}});
    }
    return table;
}

} // namespace

Json to_json(const Analysis& analysis)
{
    const Agreement& agreement = analysis.agreement;
    const auto settled = agreement.settled_discrepancy;
    return {{"discrepancy_x_mm", json_of(agreement.discrepancy_x)},
            {"force_discrepancy_n", json_of(agreement.force_discrepancy)},
            {"settled_discrepancy_mm", settled ? number(mm * *settled) : Json(nullptr)},
            {"touching",
             {{"a", agreement.touching.a},
              {"b", agreement.touching.b},
              {"either", agreement.touching.either},
              {"both", agreement.touching.both}}},
            {"scored_s", base::to_seconds(agreement.scored)},
            {"overlap", agreement.overlap},
            {"a_to_b", json_of(analysis.a_to_b)},
            {"b_to_a", json_of(analysis.b_to_a)},
            {"a", json_of(analysis.a)},
            {"b", json_of(analysis.b)},
            {"clock",
             {{"method", name_of(analysis.clock.method)},
              {"offset_ms", ms(analysis.clock.offset)},
              {"uncertainty_ms", ms(analysis.clock.uncertainty)}}},
            {"valid", analysis.valid()},
            {"invalid_because", analysis.invalid_because}};
}

std::vector<TextTable> tables_of(const Analysis& analysis)
{
    return {distances_table(analysis.agreement), touching_table(analysis.agreement),
            network_table(analysis.a_to_b, analysis.b_to_a), loops_table(analysis.a, analysis.b)};
}

std::string clock_text(const Clock& clock)
{
    if (clock.method == ClockMethod::same_boot) return "";
    return fmt::format("two clocks: B is {:.3f} ms ahead of A, known within {:.3f} ms",
                       ms(clock.offset), ms(clock.uncertainty));
}

std::string to_table(const Analysis& analysis)
{
    std::string text;
    for (const TextTable& table : tables_of(analysis)) text += to_text(table) + '\n';
    if (const auto clock = clock_text(analysis.clock); !clock.empty()) text += clock + "\n\n";
    text += analysis.valid() ? "valid\n" : "NOT VALID\n";
    for (const std::string& reason : analysis.invalid_because) text += "  " + reason + '\n';
    return text;
}

} // namespace hapnet::lab::records

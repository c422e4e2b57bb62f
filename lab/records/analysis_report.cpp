// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/analysis_report.hpp"

#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::lab {

namespace {

using Json = nlohmann::ordered_json;

constexpr double mm = 1e3; // metres into millimetres

double ms(base::Duration duration) { return 1e-6 * static_cast<double>(duration.count()); }
double us(base::Duration duration) { return 1e-3 * static_cast<double>(duration.count()); }

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
Json number(std::optional<double> value) { return value ? number(*value) : Json(nullptr); }

Json json_of(const std::optional<Spread>& spread)
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

Json json_of(const std::optional<Quantiles>& quantiles, double (*unit)(base::Duration))
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

/// A number as a cell of the table; "-" where there is none.
std::string cell(std::optional<double> value, int digits)
{
    return value && std::isfinite(*value) ? fmt::format("{:.{}f}", *value, digits) : "-";
}

template <typename T>
std::optional<double> part(const std::optional<T>& whole, auto member, double unit)
{
    if (!whole) return std::nullopt;
    return unit * ((*whole).*member);
}

std::string row(std::string_view name, const std::string& a, const std::string& b)
{
    return fmt::format("{:<26}{:>12}{:>12}\n", name, a, b);
}

std::string cell(const std::optional<Quantiles>& quantiles, base::Duration Quantiles::*member,
                 double (*unit)(base::Duration))
{
    return quantiles ? cell(unit((*quantiles).*member), 3) : "-";
}

std::string table_of(const Agreement& agreement)
{
    const auto& x = agreement.discrepancy_x;
    const auto& force = agreement.force_discrepancy;
    std::string text;
    text += fmt::format("{:<26}{:>10}{:>10}{:>10}{:>10}\n", "", "mean", "min", "max", "std");
    text += fmt::format("{:<26}{:>10}{:>10}{:>10}{:>10}\n", "cube |x_A - x_B|, mm",
                        cell(part(x, &Spread::mean, mm), 3), cell(part(x, &Spread::min, mm), 3),
                        cell(part(x, &Spread::max, mm), 3), cell(part(x, &Spread::std, mm), 3));
    text += fmt::format("{:<26}{:>10}{:>10}{:>10}\n", "force ||F_A| - |F_B||, N",
                        cell(part(force, &ForceDiscrepancy::mean, 1.0), 3), "",
                        cell(part(force, &ForceDiscrepancy::max, 1.0), 3));
    const auto settled = agreement.settled_discrepancy;
    text += fmt::format("{:<26}{:>10}\n", "settled, mm",
                        cell(settled ? std::optional{mm * *settled} : std::nullopt, 4));
    const TouchShares& touching = agreement.touching;
    text += fmt::format("{:<26}{:>10}{:>10}{:>10}{:>10}\n", "", "A", "B", "either", "both");
    text +=
        fmt::format("{:<26}{:>10.1f}{:>10.1f}{:>10.1f}{:>10.1f}\n", "touching the cube, %",
                    1e2 * touching.a, 1e2 * touching.b, 1e2 * touching.either, 1e2 * touching.both);
    text += fmt::format("{:<26}{:>10.3f}\n", "scored, s", base::to_seconds(agreement.scored));
    text += fmt::format("{:<26}{:>10.2f}\n", "overlap, %", 1e2 * agreement.overlap);
    return text;
}

std::string table_of(const Path& up, const Path& down)
{
    const auto percent = [](std::optional<double> share) {
        return cell(share ? std::optional{1e2 * *share} : std::nullopt, 3);
    };
    std::string text = row("", "A to B", "B to A");
    text += row("sent", std::to_string(up.sent), std::to_string(down.sent));
    text += row("received", std::to_string(up.received), std::to_string(down.received));
    text += row("duplicates", std::to_string(up.duplicates), std::to_string(down.duplicates));
    text += row("reordered", std::to_string(up.reordered), std::to_string(down.reordered));
    text += row("loss, %", percent(up.loss), percent(down.loss));
    text += row("sent per second", cell(up.packets_per_s, 2), cell(down.packets_per_s, 2));
    const auto times = [&](std::string_view name, auto of, auto member) {
        text += row(name, cell(up.*of, member, ms), cell(down.*of, member, ms));
    };
    times("delay p50, ms", &Path::delay, &Quantiles::p50);
    times("delay p99, ms", &Path::delay, &Quantiles::p99);
    times("delay max, ms", &Path::delay, &Quantiles::max);
    times("jitter p50, ms", &Path::jitter, &Quantiles::p50);
    times("jitter p99, ms", &Path::jitter, &Quantiles::p99);
    return text;
}

std::string table_of(const Loop& a, const Loop& b)
{
    std::string text = row("", "A", "B");
    text += row("ticks per second", cell(a.rate_hz, 2), cell(b.rate_hz, 2));
    text += row("ticks missed", std::to_string(a.missed), std::to_string(b.missed));
    text +=
        row("late p50, us", cell(a.late, &Quantiles::p50, us), cell(b.late, &Quantiles::p50, us));
    text +=
        row("late p99, us", cell(a.late, &Quantiles::p99, us), cell(b.late, &Quantiles::p99, us));
    text +=
        row("late max, us", cell(a.late, &Quantiles::max, us), cell(b.late, &Quantiles::max, us));
    return text;
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

std::string to_table(const Analysis& analysis)
{
    std::string text = table_of(analysis.agreement);
    text += '\n' + table_of(analysis.a_to_b, analysis.b_to_a);
    text += '\n' + table_of(analysis.a, analysis.b);
    if (analysis.clock.method == ClockMethod::echo) {
        text += fmt::format("\ntwo clocks: B is {:.3f} ms ahead of A, known within {:.3f} ms\n",
                            ms(analysis.clock.offset), ms(analysis.clock.uncertainty));
    }
    text += analysis.valid() ? "\nvalid\n" : "\nNOT VALID\n";
    for (const std::string& reason : analysis.invalid_because) text += "  " + reason + '\n';
    return text;
}

} // namespace hapnet::lab

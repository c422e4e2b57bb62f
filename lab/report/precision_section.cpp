// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/precision.hpp"
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <utility>

namespace hapnet::lab::report {

namespace {

using PrecisionRows = std::vector<results::PrecisionRow>;

/// Of the finest value first.
constexpr std::array<std::string_view, 6> colours{"base",  "sep",    "dead-reckoning",
                                                  "other", "missed", "muted"};

/// "0.5ms" in its parts; nullopt: no number.
struct Measured {
    double number = 0.0;
    std::string_view unit;
};
std::optional<Measured> measured(std::string_view text)
{
    Measured value;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value.number);
    if (error != std::errc{} || !(value.number > 0.0)) return std::nullopt;
    value.unit = text.substr(static_cast<std::size_t>(end - text.data()));
    return value;
}

/// The row by all seeds of each value.
PrecisionRows by_all_seeds(const PrecisionRows& rows)
{
    PrecisionRows kept;
    for (const results::PrecisionRow& row : rows) {
        if (!kept.empty() && kept.back().value == row.value) kept.pop_back();
        kept.push_back(row);
    }
    return kept;
}

/// By the differences that chance does not explain; nullopt, too, when they change their sign.
std::optional<double> order_of_figure(const PrecisionRows& by_value)
{
    const auto reference = measured(by_value.front().reference);
    std::vector<metrics::StepError> errors;
    bool is_above = false, is_below = false;
    for (const results::PrecisionRow& row : by_value) {
        const auto step = measured(row.value);
        const bool is_sure = !row.ci_low || *row.ci_low > 0.0 || *row.ci_high < 0.0;
        if (row.value == row.reference || !is_sure || row.difference == 0.0) continue;
        if (!step || !reference || step->unit != reference->unit) return std::nullopt;
        is_above = is_above || row.difference > 0.0;
        is_below = is_below || row.difference < 0.0;
        errors.push_back({step->number, std::abs(row.difference)});
    }
    if (!reference || (is_above && is_below)) return std::nullopt;
    return metrics::order_of(errors, reference->number);
}

/// "vibration_mm" as "vibration, mm"; what has its unit already stays.
std::string words_of_figure(std::string figure)
{
    for (const std::string_view unit : {"_mm", "_n"}) {
        if (!figure.ends_with(unit)) continue;
        figure.replace(figure.size() - unit.size(), 1, ", ");
        if (unit == "_n") figure.back() = 'N';
    }
    std::ranges::replace(figure, '_', ' ');
    return figure;
}

std::string number(std::optional<double> value)
{
    return value ? fmt::format("{:.3g}", *value) : "–";
}

std::string difference_of(const results::PrecisionRow& row)
{
    if (row.value == row.reference) return "reference";
    if (!row.ci_low || !row.ci_high) return number(row.difference);
    return fmt::format("{}\n({} … {})", number(row.difference), number(row.ci_low),
                       number(row.ci_high));
}

Json table_of(const PrecisionRows& rows, const std::vector<PrecisionRows>& figures)
{
    const auto values = distinct(rows, [](const auto& row) { return row.value; });
    const std::string& parameter = rows.front().parameter;
    page::Table table{
        "Differences from the reference, with their 95 % intervals; the order in which "
        "they fall, by the differences that chance does not explain; and how far the "
        "result of 1, of 10 and of all seeds is off at the reference",
        {"algorithm", "task", "figure", "at the\nreference"}};
    for (const std::string& value : values)
        table.heads.push_back(fmt::format("{}\n{}", parameter, value));
    for (const char* head : {"order", "1 seed", "10 seeds", "all seeds"})
        table.heads.push_back(head);
    for (const PrecisionRows& figure : figures) {
        const PrecisionRows all = by_all_seeds(figure);
        const results::PrecisionRow& first = figure.front();
        const PrecisionRows here = rows_where(
            figure, [](const results::PrecisionRow& row) { return row.value == row.reference; });
        const auto error_by = [&](std::uint32_t seeds) {
            const auto row = std::ranges::find(here, seeds, &results::PrecisionRow::seeds);
            return here.size() < 2 || row == here.end() ? "–" : number(row->error);
        };
        auto& cells = table.rows.emplace_back();
        cells = {{first.algorithm},
                 {first.task, "name"},
                 {words_of_figure(first.figure), "words"},
                 {here.empty() ? "–" : number(here.front().found)}};
        for (const std::string& value : values) {
            const auto row = std::ranges::find(all, value, &results::PrecisionRow::value);
            cells.push_back({row == all.end() ? "–" : difference_of(*row)});
        }
        cells.push_back({shown(order_of_figure(all), 1)});
        cells.push_back({error_by(1)});
        cells.push_back({error_by(10)});
        cells.push_back({here.empty() ? "–" : error_by(here.back().seeds)});
    }
    return json_of(table);
}

/// Error against cost: of each value a curve over the number of seeds, or of one seed a curve over
/// the values.
std::optional<page::Figure> drawn(const PrecisionRows& figure)
{
    auto values = distinct(figure, [](const auto& row) { return row.value; });
    std::ranges::reverse(values); // the last first, mostly the finest
    const bool is_one = figure.size() == values.size();
    std::vector<page::Curve> curves;
    const auto begin = [&](std::string_view name) {
        curves.push_back({.name = std::string{name},
                          .colour = colours[curves.size() % colours.size()],
                          .shows_points = true});
    };
    if (is_one) begin(figure.front().parameter);
    for (const auto& value : values) {
        if (!is_one) begin(value);
        for (const results::PrecisionRow& row : figure) {
            if (row.value == value && row.error && *row.error > 0.0)
                curves.back().points.push_back({static_cast<double>(row.ticks), *row.error});
        }
    }
    std::erase_if(curves, [](const page::Curve& curve) { return curve.points.empty(); });
    if (curves.empty()) return std::nullopt;
    const results::PrecisionRow& first = figure.front();
    const std::string words = words_of_figure(first.figure);
    return page::Figure{.id = page::plain_id(fmt::format("precision-{}-{}-{}", first.algorithm,
                                                         first.task, first.figure)),
                        .title = fmt::format("{}, {}", first.algorithm, first.task),
                        .x = {"ticks played", "", page::Scale::logarithmic},
                        .y = {"error of " + words, "", page::Scale::logarithmic},
                        .content = page::Curves{std::move(curves)},
                        .size = {360.0, 260.0},
                        .caption = fmt::format("{} in {}: {}", first.algorithm, first.task, words)};
}

/// The rows of each figure.
std::vector<PrecisionRows> figures_of(const PrecisionRows& rows)
{
    std::vector<PrecisionRows> figures;
    for (const results::PrecisionRow& row : rows) {
        const bool is_next = figures.empty() || figures.back().front().algorithm != row.algorithm ||
                             figures.back().front().task != row.task ||
                             figures.back().front().figure != row.figure;
        if (is_next) figures.emplace_back();
        figures.back().push_back(row);
    }
    return figures;
}

} // namespace

std::optional<Section> precision_section(const results::Results& results)
{
    if (results.precision.empty()) return std::nullopt;
    Section section{"precision", "What accuracy costs"};
    section.add(page::paragraph(page::text_of(
        {"Each point is a result by fewer seeds, or at a coarser step: how far it is off from the "
         "same figure by all seeds at the reference, as the root mean square over many draws of "
         "the seeds. The cost is in ticks of all players, on perfect networks, too; the processor "
         "time of the run stands under ",
         page::link("how to repeat it", "#runs"),
         ". A curve that no longer falls with more seeds has reached the error of its step."})));
    section.sources = files_named(results, "precision.csv");
    for (const auto& parameter :
         distinct(results.precision, [](const auto& row) { return row.parameter; })) {
        const PrecisionRows rows =
            rows_where(results.precision, [&](const results::PrecisionRow& row) {
                return row.parameter == parameter;
            });
        const auto figures = figures_of(rows);
        section.add(table_of(rows, figures));
        for (const auto& algorithm : distinct(rows, [](const auto& r) { return r.algorithm; })) {
            Json of_algorithm = Json::array();
            for (const PrecisionRows& figure : figures) {
                if (figure.front().algorithm != algorithm) continue;
                if (auto one = drawn(figure)) of_algorithm.push_back(section.keep(*std::move(one)));
            }
            Json panels = page::panels("small", std::move(of_algorithm));
            const bool is_first = algorithm == rows.front().algorithm;
            section.add(is_first ? std::move(panels)
                                 : page::folded(fmt::format("Error against cost: {}", algorithm),
                                                Json::array({std::move(panels)})));
        }
    }
    return section;
}

} // namespace hapnet::lab::report

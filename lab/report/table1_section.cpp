// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "lab/results/paper.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

using namespace std::string_view_literals;

namespace {

/// One number of Table 1, ours and the paper's.
struct Quantity {
    std::string_view name;
    double results::Table1Row::*ours;
    std::optional<double> results::Table1Row::*papers;
    results::Band results::Table1Bands::*band;
};

constexpr std::array quantities{
    Quantity{"mean", &results::Table1Row::mean_mm, &results::Table1Row::paper_mean_mm,
             &results::Table1Bands::mean_mm},
    Quantity{"std", &results::Table1Row::std_mm, &results::Table1Row::paper_std_mm,
             &results::Table1Bands::std_mm},
    Quantity{"max", &results::Table1Row::max_mm, &results::Table1Row::paper_max_mm,
             &results::Table1Bands::max_mm}};

page::Cell measured_cell(double value, const std::optional<results::Band>& band)
{
    const bool is_outside = band && !band->holds(value);
    return {shown(value, 2), is_outside ? "ours missed" : "ours"};
}

page::Cell band_cell(const std::optional<results::Band>& band)
{
    if (!band) return {"–", "band"};
    return {fmt::format("{} to {}", shown(band->low, 2), shown(band->high, 2)), "band"};
}

metrics::Spread spread_of(const results::Table1Row& row)
{
    return {row.mean_mm, row.min_mm, row.max_mm, row.std_mm};
}

/// Where the numbers of a row agree; nullopt when there is nothing to hold them against.
std::optional<results::Table1Bands> bands_of(const results::Results& results,
                                             const results::Table1Row& row)
{
    std::optional<metrics::Spread> base;
    for (const results::Table1Row& other : results.table1) {
        if (other.algorithm == "base") base = spread_of(other);
    }
    return results::table1_bands(row.algorithm, base);
}

std::optional<results::Band> band_of(const std::optional<results::Table1Bands>& bands,
                                     results::Band results::Table1Bands::*band)
{
    return bands ? std::optional{(*bands).*band} : std::nullopt;
}

Json table_of(const results::Results& results)
{
    page::Table table{"|x at L − x at R| of the cube in task P1, mm: this run, the paper, and from "
                      "where to where it agrees",
                      {"algorithm"}};
    for (const Quantity& quantity : quantities) {
        for (const std::string_view head : {quantity.name, "paper"sv, "band"sv})
            table.heads.emplace_back(head);
    }
    for (const char* head : {"min", "verdict", "class", "class\nof max"})
        table.heads.emplace_back(head);
    for (const results::Table1Row& row : results.table1) {
        const auto bands = bands_of(results, row);
        std::vector<page::Cell> cells{{row.algorithm}};
        for (const Quantity& quantity : quantities) {
            cells.push_back(measured_cell(row.*quantity.ours, band_of(bands, quantity.band)));
            cells.push_back({shown(row.*quantity.papers, 2), "paper"});
            cells.push_back(band_cell(band_of(bands, quantity.band)));
        }
        cells.push_back({shown(row.min_mm, 2), "ours"});
        const bool is_predicted = row.provenance == results::Provenance::predicted;
        cells.push_back({row.verdict == results::Claim::met && !is_predicted
                             ? page::badge("met", "seen")
                             : claim_badge(row.verdict)});
        cells.push_back({class_badge(row.provenance)});
        cells.push_back({class_badge(row.max_provenance)});
        table.rows.push_back(std::move(cells));
    }
    return json_of(table);
}

/// Ours beside the paper's, one group for each algorithm.
page::Figure bars_of(const results::Results& results, const Quantity& quantity)
{
    page::Bars groups;
    for (const results::Table1Row& row : results.table1) {
        page::BarGroup group{row.algorithm, {}};
        const auto colour = colour_of(row.algorithm);
        if (const auto paper = row.*quantity.papers) {
            group.bars.push_back(
                {.series = "paper",
                 .value = *paper,
                 .text = shown(*paper, 1),
                 .colour = colour,
                 .is_outlined = true,
                 .tip = fmt::format("{}, paper: {} mm", row.algorithm, shown(*paper, 2))});
        }
        const double ours = row.*quantity.ours;
        const auto band = band_of(bands_of(results, row), quantity.band);
        group.bars.push_back(
            {.series = "this run",
             .value = ours,
             .text = shown(ours, 1),
             .colour = colour,
             .is_missed = band && !band->holds(ours),
             .tip = fmt::format("{}, this run: {} mm", row.algorithm, shown(ours, 2))});
        groups.push_back(std::move(group));
    }
    return {.id = fmt::format("table1-{}", quantity.name),
            .title = fmt::format("Table 1: {}", quantity.name),
            .x = {"left: paper, right: this run"},
            .y = {"|x_L − x_R|", "mm"},
            .content = std::move(groups),
            .size = {360.0, 240.0},
            .caption = fmt::format("Dashed: the paper. Filled: this run, {}.", quantity.name)};
}

} // namespace

std::optional<Section> table1_section(const results::Results& results)
{
    if (results.table1.empty()) return std::nullopt;
    Section section{"table1", "Table 1: how far the two copies are apart"};
    section.add(page::paragraph(
        "One hand carries the cube; the other side sees it late. The distance between the two "
        "copies is what the network costs. Sep stands where the paper has TiDeC. The hand follows "
        "a prescribed path and the delay is constant: nothing is drawn by lot, so there is one "
        "session of each algorithm, whatever the seed, and no interval."));
    section.add(table_of(results));
    section.sources = files_named(results, "table1.csv");
    Json figures = Json::array();
    for (const Quantity& quantity : quantities)
        figures.push_back(section.keep(bars_of(results, quantity)));
    section.add(page::panels("small", std::move(figures)));
    return section;
}

namespace {

/// Each seed's mean discrepancy, one plot for each task.
std::optional<page::Figure> seeds_figure(const results::Results& results, const std::string& task)
{
    const auto names = distinct(results.tasks, [](const auto& row) { return row.algorithm; });
    std::vector<page::Curve> curves;
    for (const std::string& name : names) {
        page::Curve curve{
            .name = name, .colour = colour_of(name), .width = 0.0, .shows_points = true};
        for (const results::SessionRow& row : results.rows_of_sessions) {
            if (row.algorithm != name || row.task != task || !row.mean_mm) continue;
            curve.points.push_back({static_cast<double>(row.seed), *row.mean_mm});
        }
        if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
    if (curves.empty()) return std::nullopt;
    return page::Figure{.id = page::plain_id("seeds-" + task),
                        .title = task,
                        .x = {"seed"},
                        .y = {"mean discrepancy", "mm", page::Scale::linear, {0.0, 0.0}},
                        .content = page::Curves{std::move(curves)},
                        .size = {360.0, 220.0},
                        .caption = task + ", a point for each seed"};
}

} // namespace

std::optional<Section> tasks_section(const results::Results& results)
{
    if (results.tasks.empty()) return std::nullopt;
    page::Table table{"Closed-loop tasks: worst of the seeds; discrepancy mean and std: mean over "
                      "the seeds",
                      {"task", "algorithm", "tier", "seeds", "mean\nmm", "std\nmm", "max\nmm",
                       "vibration\nmm", "stiffness\nratio", "force\nvibration, N",
                       "force above\n2 Hz, N", "forces\napart, %", "contact\nlost, %",
                       "force\nstep, N", "drag\nN", "energy\nmJ", "limited by"}};
    const bool turn = std::ranges::any_of(results.tasks, [](const results::TaskRow& row) {
        return row.turned_apart_deg.has_value();
    });
    if (turn) table.heads.emplace_back("turned\napart, max deg");
    const auto percent = [](std::optional<double> share) {
        return shown(share ? std::optional{100.0 * *share} : std::nullopt, 1);
    };
    for (const std::string& task : distinct(results.tasks, [](const auto& r) { return r.task; })) {
        for (const results::TaskRow& row : results.tasks) {
            if (row.task != task) continue;
            table.rows.push_back({{task},
                                  {row.algorithm, "name"},
                                  {tier_badge(row.tier), "name"},
                                  {std::to_string(row.seeds)},
                                  {shown(row.mean_mm, 2)},
                                  {shown(row.std_mm, 2)},
                                  {shown(row.max_mm, 2)},
                                  {shown(row.vibration_mm, 3)},
                                  {shown(row.stiffness_ratio, 3)},
                                  {shown(row.force_vibration_n, 3)},
                                  {shown(row.force_above_2hz_n, 3)},
                                  {percent(row.force_discrepancy)},
                                  {percent(row.contact_lost)},
                                  {shown(row.force_step_n, 3)},
                                  {shown(row.drag_n, 3)},
                                  {shown(row.energy_mj, 2)},
                                  {row.limited_by, "words"}});
            if (turn) table.rows.back().push_back({shown(row.turned_apart_deg, 2)});
        }
    }
    Section section{"tasks", "The closed-loop tasks beside it"};
    section.add(page::paragraph(
        "In P1 the cube follows a path whatever is felt. In these tasks both hands act on what "
        "they feel, so the numbers are not Table 1’s: they say what the same network does to "
        "people who work together."));
    section.add(json_of(table));
    section.sources = files_named(results, "sessions.csv");
    Json figures = Json::array();
    for (const std::string& task : distinct(results.tasks, [](const auto& r) { return r.task; })) {
        if (auto seeds = seeds_figure(results, task))
            figures.push_back(section.keep(*std::move(seeds)));
    }
    section.add(page::panels("small", std::move(figures)));
    return section;
}

} // namespace hapnet::lab::report

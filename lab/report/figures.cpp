// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/figures.hpp"

#include "lab/metrics/paired.hpp"
#include "lab/report/patterns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

using Keys = std::vector<std::string_view>;

constexpr page::Size third_of_width{360.0, 240.0};

std::vector<double> numbers_of(const Rows& rows, std::string_view key)
{
    std::vector<double> values;
    for (const TableRow& row : rows)
        if (const auto value = row.number(key)) values.push_back(*value);
    return values;
}

// --- Fig. 7

constexpr std::size_t points_max = 6000; // for a curve: finer than pixels even when zoomed

std::vector<page::Point> points_of(const Rows& rows, std::string_view key)
{
    std::vector<page::Point> points;
    for (const TableRow& row : rows)
        if (const auto value = row.number(key)) points.push_back({*row.number("time_s"), *value});
    return page::thinned(points, points_max);
}

/// A value that is drawn for both sides over time.
struct BothSides {
    std::string_view id;
    std::string_view title; // text after the algorithm's name
    std::string_view names; // prefix of the curves' names, before the side's letter
    std::string_view keys;  // prefix of the columns' keys, before the side's letter
    page::Axis y;
};
const std::array drawn_of_both{
    BothSides{"fig7", "", "cube at ", "cube_", {"x of the cube", "mm"}},
    BothSides{"fig7-hands", ": hands", "hand ", "hand_", {"x of the hand", "mm"}},
    BothSides{"fig7-forces", ": forces", "on hand ", "force_", {"force along x", "N"}}};

page::Figure over_time(std::string id, std::string title, page::Axis y,
                       std::vector<page::Curve> curves)
{
    return {.id = page::plain_id(std::move(id)),
            .title = std::move(title),
            .x = {"time", "s"},
            .y = std::move(y),
            .content = page::Curves{std::move(curves)},
            .size = {900.0, 230.0}};
}

page::Figure both_sides_figure(const Rows& rows, const BothSides& both)
{
    const std::string algorithm = rows.front().text("algorithm");
    const std::string_view unit = both.y.unit == "N" ? "_n" : "_mm";
    const auto curve = [&](char letter, char side, std::string_view colour) {
        return page::Curve{.name = fmt::format("{}{}", both.names, letter),
                           .colour = colour,
                           .points = points_of(rows, fmt::format("{}{}{}", both.keys, side, unit))};
    };
    auto figure = over_time(fmt::format("{}-{}", both.id, algorithm),
                            fmt::format("{}{}", algorithm, both.title), both.y,
                            {curve('A', 'l', "left"), curve('B', 'r', "right")});
    figure.caption = algorithm;
    return figure;
}

/// Draws the difference of two curves that nearly coincide.
page::Figure difference_figure(const Rows& rows)
{
    const std::string algorithm = rows.front().text("algorithm");
    auto figure = over_time("fig7-difference-" + algorithm, algorithm + ": difference",
                            {"x at A − x at B", "mm"},
                            {{.name = "x of the cube at A − at B",
                              .colour = colour_of(algorithm),
                              .points = points_of(rows, "apart_mm")}});
    figure.size.height = 170.0;
    figure.caption = algorithm + ": the copies’ difference, on one scale for all.";
    return figure;
}

/// Describes the visible result: how far the copies are apart, and how a following copy moves.
std::string apart_text(const Rows& rows)
{
    constexpr double step_mm = 5.0; // no hand moves a cube by this much between two rows
    double sum = 0.0, most = 0.0;
    std::size_t steps = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double apart = std::abs(rows[i].number("apart_mm").value_or(0.0));
        sum += apart;
        most = std::max(most, apart);
        const auto has_jumped = [&](std::string_view key) {
            return std::abs(rows[i].number(key).value_or(0.0) -
                            rows[i - 1].number(key).value_or(0.0)) > step_mm;
        };
        if (i > 0 && (has_jumped("cube_l_mm") || has_jumped("cube_r_mm"))) ++steps;
    }
    const auto apart =
        fmt::format("{}: the copies are {} mm apart on average and {} mm at most.",
                    rows.front().text("algorithm"),
                    shown(sum / static_cast<double>(rows.size()), 2), shown(most, 1));
    if (steps == 0) return apart + " No copy jumps by more than 5 mm from one row to the next.";
    return fmt::format("{} A copy jumps by more than 5 mm from one row to the next {} times: it "
                       "moves vigorously, and does not follow the curve of the other.",
                       apart, steps);
}

// --- The plane of conditions

std::vector<double> ascending(const Rows& rows, std::string_view key)
{
    std::vector<double> values;
    for (const TableRow& row : rows) values.push_back(row.number(key).value_or(0.0));
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

std::size_t index_of(const std::vector<double>& values, std::optional<double> value)
{
    const auto found = std::ranges::find(values, value.value_or(0.0));
    return static_cast<std::size_t>(found - values.begin());
}

/// The tiers, the worst first, with their symbols in a heat map.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> tiers{
    {{"unusable", "×"}, {"usable", "○"}, {"good", "●"}}};

std::size_t rank_of(const TableRow& row)
{
    const auto* const found =
        std::ranges::find(tiers, row.text("tier"), [](const auto& tier) { return tier.first; });
    return static_cast<std::size_t>(found - tiers.begin());
}

/// Returns a cell of the heat map: the worst of the tasks, with the values of each task.
page::HeatCell heat_cell(const Rows& rows)
{
    const auto worst = std::ranges::min(rows, {}, rank_of);
    const auto& [colour, symbol] = tiers[std::min(rank_of(worst), tiers.size() - 1)];
    page::HeatCell cell{.colour = colour, .symbol = symbol, .tip = {}};
    cell.tip = in_words("{delay_ms:g} ms, ± {jitter_ms:g} ms, {loss_percent:g} %", rows.front());
    for (const TableRow& row : rows) {
        cell.tip += in_words("\n{task}: {tier}, vibration {vibration_mm:.3} mm, stiffness "
                             "{stiffness_ratio:.2}, force vibration {force_vibration_n:.3} N",
                             row);
        if (row.number("turned_apart_deg"))
            cell.tip += in_words(", copies turned apart {turned_apart_deg:.2} deg", row);
        // The reason why the session misses the next tier: each metric with its value and its
        // limit.
        if (const auto reason = row.text("limited_by"); !reason.empty())
            cell.tip += fmt::format("; {}", reason);
    }
    return cell;
}

/// Returns the heat map of one algorithm at one loss.
page::Figure plane_map(const Rows& rows, const std::vector<double>& delays,
                       const std::vector<double>& jitters)
{
    page::HeatMap map;
    for (const double delay : delays) map.columns.push_back(fmt::format("{:g}", delay));
    for (const double jitter : jitters)
        map.rows.push_back(fmt::format("{}{:g}", jitter > 0.0 ? "± " : "", jitter));
    for (const Rows& alike : split(rows, Keys{"delay_ms", "jitter_ms"})) {
        auto& cell = map.cells.emplace_back(heat_cell(alike));
        cell.column = index_of(delays, alike.front().number("delay_ms"));
        cell.row = index_of(jitters, alike.front().number("jitter_ms"));
    }
    std::ranges::sort(map.cells, {}, [](const page::HeatCell& cell) {
        return std::pair{cell.row, cell.column};
    });
    const std::string title = in_words("{algorithm}, {loss_percent:g} % loss", rows.front());
    return {.id = page::plain_id(in_words("qos-{algorithm}-{loss_percent:g}", rows.front())),
            .title = title,
            .x = {"delay", "ms"},
            .y = {"jitter", "ms"},
            .content = std::move(map),
            .size = {280.0, 90.0 + 34.0 * static_cast<double>(jitters.size())},
            .caption = title};
}

// --- Errors against cost

/// The colours. The finest value has the first one.
constexpr std::array<std::string_view, 6> colours{"base",  "sep",    "dead-reckoning",
                                                  "other", "missed", "muted"};

/// Draws a curve over the number of seeds for each value; for a single number of seeds, one curve
/// over the values.
void add_precision_figure(const Rows& rows, FigureGroup& group)
{
    auto values = distinct(rows, "value");
    std::ranges::reverse(values); // last value first, which is usually the finest
    const bool is_one = rows.size() == values.size();
    std::vector<page::Curve> curves;
    const auto begin = [&](const std::string& name) {
        curves.push_back({.name = name,
                          .colour = colours[curves.size() % colours.size()],
                          .shows_points = true});
    };
    if (is_one) begin(rows.front().text("parameter"));
    for (const auto& value : values) {
        if (!is_one) begin(value);
        for (const TableRow& row : where(rows, "value", value)) {
            const auto ticks = row.number("ticks"), error = row.number("error");
            if (ticks && error && *error > 0.0) curves.back().points.push_back({*ticks, *error});
        }
    }
    std::erase_if(curves, [](const page::Curve& curve) { return curve.points.empty(); });
    if (curves.empty()) return;
    const std::string figure = rows.front().text("figure");
    const auto unit = results::unit_of(figure);
    const std::string words = unit.empty() ? results::label_of(figure)
                                           : fmt::format("{}, {}", results::label_of(figure), unit);
    group.figures.push_back(
        {.id = page::plain_id(in_words("precision-{algorithm}-{task}-{figure}", rows.front())),
         .title = in_words("{algorithm}, {task}", rows.front()),
         .x = {"ticks played", "", page::Scale::logarithmic},
         .y = {"error of " + words, "", page::Scale::logarithmic},
         .content = page::Curves{std::move(curves)},
         .size = {360.0, 260.0},
         .caption = in_words("{algorithm} in {task}: ", rows.front()) + words});
}

/// Returns the percentage of points at which an algorithm is usable in all these rows.
double borne_percent(const Rows& rows)
{
    const auto points = split(rows, Keys{"point"});
    const auto borne = std::ranges::count_if(points, [](const Rows& of_point) {
        return std::ranges::all_of(of_point, [](const TableRow& row) { return rank_of(row) > 0; });
    });
    return points.empty() ? 0.0
                          : 100.0 * static_cast<double>(borne) / static_cast<double>(points.size());
}

} // namespace

FigureGroups table1_figures(const results::Results& results)
{
    FigureGroup group;
    const Rows all = results.rows("table1");
    const bool has_paper = std::ranges::any_of(
        all, [](const TableRow& row) { return row.number("paper_mean_mm").has_value(); });
    for (const auto& [name, title] : {std::pair{"mean", "Mean distance of the two copies"},
                                      {"std", "Its standard deviation"},
                                      {"max", "Largest distance of the two copies"}}) {
        const std::string ours = fmt::format("{}_mm", name), paper = "paper_" + ours;
        const std::string lowest = fmt::format("{}_low_mm", name),
                          highest = fmt::format("{}_high_mm", name);
        const Table table = with_column(
            results.table("table1"), "missed", [&](const TableRow& row) -> results::Cell {
                const auto value = row.number(ours);
                const auto low = row.number(lowest), high = row.number(highest);
                return value && ((low && *value < *low) || (high && *value > *high));
            });
        const auto cell = [](const std::string& key, int decimals) {
            return fmt::format("{{{}:.{}}}", key, decimals);
        };
        const std::array bars{
            BarPattern{"paper", paper, cell(paper, 1),
                       fmt::format("{{algorithm}}, paper: {} mm", cell(paper, 2)), true},
            BarPattern{"this run", ours, cell(ours, 1),
                       fmt::format("{{algorithm}}, this run: {} mm", cell(ours, 2))}};
        group.figures.push_back(
            {.id = fmt::format("table1-{}", name),
             .title = title,
             .x = {"algorithm"},
             .y = {fmt::format("{} of |x_A − x_B|", name), "mm"},
             .content = bars_of(rows_of(table), "{algorithm}", bars),
             .size = third_of_width,
             .caption = has_paper ? "Dashed: the paper. Filled: this run." : ""});
    }
    return {group};
}

FigureGroups tasks_figures(const results::Results& results)
{
    FigureGroup group;
    for (const std::string& task : distinct(results.rows("tasks"), "task")) {
        page::Dots dots;
        double seeds = 0.0; // the same for each algorithm
        const Rows of_task = where(results.rows("sessions"), "task", task);
        for (const std::string& algorithm : distinct(of_task, "algorithm")) {
            auto values = numbers_of(where(of_task, "algorithm", algorithm), "mean_mm");
            if (values.empty()) continue;
            const double mean = mean_of(values);
            page::DotRow dot{.name = algorithm,
                             .colour = colour_of(algorithm),
                             .value = mean,
                             .tip =
                                 fmt::format("{} in {}: {} mm", algorithm, task, shown(mean, 2))};
            seeds = static_cast<double>(values.size());
            if (seeds > 1.0) {
                const auto [low, high] = metrics::interval_of_mean(values);
                dot.interval = page::Range{low, high};
                dot.tip += fmt::format(" ({} to {}: {})", shown(low, 2), shown(high, 2),
                                       about_spread(seeds));
            }
            dot.single = std::move(values);
            dots.push_back(std::move(dot));
        }
        if (dots.empty()) continue;
        const double height = 90.0 + 40.0 * static_cast<double>(dots.size());
        group.figures.push_back(
            {.id = page::plain_id("seeds-" + task),
             .title = "Task " + task,
             .x = {"mean distance of the copies", "mm", page::Scale::linear, {0.0, 0.0}},
             .y = {"algorithm"},
             .content = std::move(dots),
             .size = {360.0, height},
             .caption = seeds < 2.0 ? std::string{"One seed: there is no interval."}
                                    : fmt::format("Large: the mean of the seeds; the line is {}. "
                                                  "Small: each seed.",
                                                  about_spread(seeds))});
    }
    return {group};
}

FigureGroups claims_figures(const results::Results& results)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> titles{
        {{"% usable", "Sessions that are usable"},
         {"mm", "How far copies are apart, or vibrate"},
         {"N", "Force that the network adds"},
         {"%", "Contact that the network costs"},
         {"mJ", "Energy that the network adds"},
         {"x of two", "Distance of three against that of two"}}};
    const std::string words =
        "Shaded: what the claim accepts. The line is the 95 % interval of a mean of six sessions "
        "or "
        "more; of fewer, and where each session is judged, it reaches from the least to the most. "
        "Red: not kept.";
    FigureGroup group;
    for (const Rows& rows : split(results.rows("claims_numbers"), Keys{"unit"})) {
        const std::string unit = rows.front().text("unit");
        const auto* const title =
            std::ranges::find(titles, unit, [](const auto& one) { return one.first; });
        page::Dots dots;
        for (const TableRow& row : rows) {
            const auto low = row.number("low"), high = row.number("high");
            page::DotRow dot{.name = row.text("claim"),
                             .colour = "accent",
                             .value = row.number("value"),
                             .accepted = page::Range{row.number("accept_low").value_or(-INFINITY),
                                                     row.number("accept_high").value_or(INFINITY)},
                             .is_missed = row.text("kept") == "false"};
            if (const auto part = row.text("number"); !part.empty()) dot.name += ": " + part;
            const bool has_spread = low && high && row.number("sessions").value_or(0.0) > 1.0;
            if (has_spread) dot.interval = page::Range{*low, *high};
            dot.tip = fmt::format(
                "{}: {}", dot.name,
                in_words(has_spread ? "{value:g} ({low:g} to {high:g}) {unit}" : "{value:g} {unit}",
                         row));
            dots.push_back(std::move(dot));
        }
        const double height = 70.0 + 44.0 * static_cast<double>(dots.size());
        const double whole = unit == "% usable" ? 100.0 : 0.0;
        group.figures.push_back(
            {.id = page::plain_id("claims-" + (unit.empty() ? "ratio" : unit)),
             .title = std::string{title == titles.end() ? "Stiffness felt, against no delay"
                                                        : title->second},
             .x = {"measured", unit.empty() ? "ratio" : unit, page::Scale::linear, {0.0, whole}},
             .y = {"claim"},
             .content = std::move(dots),
             .size = {440.0, height},
             .caption = group.figures.empty() ? words : ""});
    }
    return {group};
}

FigureGroups precision_figures(const results::Results& results)
{
    FigureGroups groups;
    for (const Rows& rows : split(results.rows("precision"), Keys{"parameter", "algorithm"})) {
        auto& group = groups.emplace_back(FigureGroup{rows.front().text("algorithm"), {}});
        for (const Rows& figure : split(rows, Keys{"task", "figure"}))
            add_precision_figure(figure, group);
    }
    return groups;
}

FigureGroups points_figures(const results::Results& results)
{
    const Rows rows = results.rows("qos_by_point");
    page::Bars bars;
    auto tasks = distinct(rows, "task");
    tasks.emplace_back("all tasks");
    for (const std::string& task : tasks) {
        auto& group = bars.emplace_back(page::BarGroup{task, {}});
        for (const std::string& algorithm : distinct(rows, "algorithm")) {
            const Rows of_algorithm = where(rows, "algorithm", algorithm);
            const double percent = borne_percent(
                &task == &tasks.back() ? of_algorithm : where(of_algorithm, "task", task));
            group.bars.push_back({.series = algorithm,
                                  .value = percent,
                                  .text = shown(percent, 0),
                                  .colour = colour_of(algorithm),
                                  .tip = fmt::format("{}, {}", algorithm, task)});
        }
    }
    return {{"",
             {{.id = "points",
               .title = "Points that are borne",
               .x = {"task"},
               .y = {"points", "%"},
               .content = std::move(bars),
               .size = {560.0, 260.0},
               .caption = fmt::format("Share of {} points that each algorithm bears",
                                      distinct(rows, "point").size())}}}};
}

FigureGroups fig7_figures(const results::Results& results)
{
    const Table table = with_column(
        results.table("trajectories"), "apart_mm", [](const TableRow& row) -> results::Cell {
            return results::to_cell(row.number("cube_l_mm").value_or(NAN) -
                                    row.number("cube_r_mm").value_or(NAN));
        });
    FigureGroup group;
    for (const Rows& rows : split(rows_of(table), Keys{"algorithm"})) {
        auto& figures = group.figures;
        figures.push_back(both_sides_figure(rows, drawn_of_both[0]));
        figures.back().caption = apart_text(rows);
        figures.push_back(difference_figure(rows));
        figures.push_back(both_sides_figure(rows, drawn_of_both[1]));
        figures.push_back(both_sides_figure(rows, drawn_of_both[2]));
    }
    return {group};
}

FigureGroups qos_figures(const results::Results& results)
{
    const Rows rows = results.rows("qos");
    const auto delays = ascending(rows, "delay_ms"), jitters = ascending(rows, "jitter_ms");
    FigureGroups groups;
    for (const Rows& of_algorithm : split(rows, Keys{"algorithm"})) {
        auto& group = groups.emplace_back(FigureGroup{of_algorithm.front().text("algorithm"), {}});
        for (const double loss : ascending(of_algorithm, "loss_percent")) {
            Rows at_loss = of_algorithm;
            std::erase_if(at_loss,
                          [&](const TableRow& row) { return row.number("loss_percent") != loss; });
            group.figures.push_back(plane_map(at_loss, delays, jitters));
        }
    }
    return groups;
}

FigureGroups real_time_figures(const results::Results& results)
{
    Rows rows = where(results.rows("real_time"), "valid", "true");
    std::erase_if(rows, [](const TableRow& row) {
        return !row.number("mean_mm") || !row.number("virtual_mean_mm");
    });
    if (rows.empty()) return {FigureGroup{}};
    const std::array bars{
        BarPattern{"virtual time", "virtual_mean_mm", "{virtual_mean_mm:.2}", "virtual time", true},
        BarPattern{"real time", "mean_mm", "{mean_mm:.2}", "real time"}};
    return {{"",
             {{.id = "real-time",
               .title = "Mean discrepancy",
               .x = {"algorithm, and where"},
               .y = {"discrepancy", "mm"},
               .content = bars_of(rows, "{algorithm}, {where}", bars),
               .size = {900.0, 250.0},
               .caption = "Dashed: virtual time. Filled: real time."}}}};
}

} // namespace hapnet::lab::report

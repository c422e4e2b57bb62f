// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/paired.hpp"
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"
#include "proto/plot/plot.hpp"

#include <algorithm>
#include <map>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

using plot::escaped;

namespace {

/// What is drawn against the level, and which way is worse.
struct Criterion {
    std::string_view name;
    std::string_view title;
    std::string_view unit;
    std::optional<double> results::Judged::*value;
    plot::Scale scale;
    double (*threshold)(const metrics::Criteria&); // of what is usable
};

constexpr std::array criteria_drawn{
    Criterion{"vibration", "Vibration of the cube above 20 Hz", "mm",
              &results::Judged::vibration_mm, plot::Scale::logarithmic,
              [](const metrics::Criteria& c) {
                  return 1e3 * at_order(c.usable.vibration_max_m, c.filter_order);
              }},
    Criterion{"stiffness", "Stiffness felt at 1 Hz", "of what it is at no delay",
              &results::Judged::stiffness_ratio, plot::Scale::linear,
              [](const metrics::Criteria& c) { return c.usable.stiffness_ratio_min; }},
    Criterion{"force-vibration", "Vibration of the force above 20 Hz", "N",
              &results::Judged::force_vibration_n, plot::Scale::logarithmic,
              [](const metrics::Criteria& c) { return c.usable.force_vibration_max_n; }}};

/// The values of the seeds at each level.
using LevelValues = std::map<double, std::vector<double>>;

LevelValues values_of(const std::vector<results::CurveRow>& rows, std::string_view algorithm,
                      const Criterion& criterion)
{
    LevelValues levels;
    for (const results::CurveRow& row : rows) {
        const auto value = row.judged.*criterion.value;
        if (row.algorithm == algorithm && value && row.counts) levels[row.level].push_back(*value);
    }
    return levels;
}

std::string unit_of(const Criterion& criterion)
{
    const bool is_log = criterion.scale == plot::Scale::logarithmic;
    return fmt::format("{}{}", criterion.unit, is_log ? ", log scale" : "");
}

/// A point for each seed, and a line through the medians. Empty when none of the rows has this
/// criterion.
Drawing curve_plot(const std::vector<results::CurveRow>& rows, const Criterion& criterion,
                   const std::string& title, const std::optional<metrics::Criteria>& criteria)
{
    std::vector<plot::Curve> curves;
    plot::PlotOptions options{.scales = {.y = criterion.scale}, .size = {360.0, 250.0}};
    if (criteria) options.levels.push_back({criterion.threshold(*criteria), "usable"});
    const auto algorithms = distinct(rows, [](const auto& row) { return row.algorithm; });
    for (const std::string& algorithm : algorithms) {
        const auto colour = colour_of(algorithm);
        plot::Curve medians{.name = algorithm, .colour = colour, .width = curve_width(algorithm)};
        plot::Curve seeds{.name = {}, .colour = colour, .width = 0.0, .shows_points = true};
        for (const auto& [level, values] : values_of(rows, algorithm, criterion)) {
            medians.points.push_back({level, metrics::median_of(values)});
            for (const double value : values) seeds.points.push_back({level, value});
        }
        if (medians.points.empty()) continue;
        curves.push_back(std::move(medians));
        curves.push_back(std::move(seeds));
    }
    if (curves.empty()) return {};
    const auto& first = rows.front();
    const std::string across =
        fmt::format("{}, {}", impairment_text(first.impairment), unit_text(first.unit));
    return drawn_plot({title, across, unit_of(criterion)}, curves, options);
}

/// Every task on its own: a line through the worst of several would jump from one to another.
void add_tasks(Section& section, const std::vector<results::CurveRow>& rows,
               const std::optional<metrics::Criteria>& criteria)
{
    for (const std::string& task : distinct(rows, [](const auto& row) { return row.task; })) {
        std::vector<results::CurveRow> of_task;
        for (const results::CurveRow& row : rows) {
            if (row.task == task) of_task.push_back(row);
        }
        for (const Criterion& criterion : criteria_drawn) {
            const auto title = fmt::format("{}: {}", task, criterion.name);
            auto drawing = curve_plot(of_task, criterion, title, criteria);
            if (drawing.svg.empty()) continue;
            section.add_figure(
                fmt::format("curve-{}-{}-{}", rows.front().impairment, task, criterion.name),
                std::move(drawing), escaped(fmt::format("{}: {}", task, criterion.title)));
        }
    }
}

bool is_measured(const std::vector<results::CurveRow>& rows, const Criterion& criterion)
{
    return std::any_of(rows.begin(), rows.end(), [&](const results::CurveRow& row) {
        return (row.judged.*criterion.value).has_value();
    });
}

/// All curves of one impairment.
void add_curves(Section& section, const std::vector<results::CurveRow>& rows,
                const std::optional<metrics::Criteria>& criteria)
{
    const std::string& name = rows.front().impairment;
    section.html +=
        fmt::format("<h3>{}</h3>\n<div class='panels small'>\n", escaped(impairment_text(name)));
    add_tasks(section, rows, criteria);
    section.html += "</div>\n";
    std::string unmeasured;
    for (const Criterion& criterion : criteria_drawn) {
        if (is_measured(rows, criterion)) continue;
        unmeasured += fmt::format("{}{}", unmeasured.empty() ? "" : ", ", criterion.name);
    }
    if (!unmeasured.empty()) {
        section.html += fmt::format("<p class='banner'>Not measured in any of these sessions, so "
                                    "no session can have failed by it: {}.</p>\n",
                                    unmeasured);
    }
}

} // namespace

std::optional<Section> curves_section(const results::Results& results)
{
    if (results.curves.empty()) return std::nullopt;
    Section section{"curves", "The curves behind the limits",
                    "<p>Every point is a session: all seeds at each level that counts. The line "
                    "joins their medians.</p>\n"};
    section.sources = links_to(results, "curves.csv");
    const auto criteria = results.criteria();
    if (criteria) section.html += "<p>The dashed line is where usable ends.</p>\n";
    for (const auto& name : distinct(results.curves, [](const auto& r) { return r.impairment; })) {
        std::vector<results::CurveRow> rows;
        for (const results::CurveRow& row : results.curves) {
            if (row.impairment == name) rows.push_back(row);
        }
        add_curves(section, rows, criteria);
    }
    return section;
}

} // namespace hapnet::lab::report

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
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
    bool is_worse_when_less;
    double (*threshold)(const metrics::Criteria&); // of what is usable
};

constexpr std::array criteria_drawn{
    Criterion{"vibration", "Vibration of the cube above 20 Hz", "mm",
              &results::Judged::vibration_mm, plot::Scale::logarithmic, false,
              [](const metrics::Criteria& c) {
                  return 1e3 * at_order(c.usable.vibration_max_m, c.filter_order);
              }},
    Criterion{"stiffness", "Stiffness felt at 1 Hz", "of what it is at no delay",
              &results::Judged::stiffness_ratio, plot::Scale::linear, true,
              [](const metrics::Criteria& c) { return c.usable.stiffness_ratio_min; }},
    Criterion{"force-vibration", "Vibration of the force above 20 Hz", "N",
              &results::Judged::force_vibration_n, plot::Scale::logarithmic, false,
              [](const metrics::Criteria& c) { return c.usable.force_vibration_max_n; }}};

/// The sessions of one level: the worst of them.
struct LevelOfCurve {
    std::optional<double> value;
    bool is_unusable = false;
};

std::map<double, LevelOfCurve> levels_of(const std::vector<results::CurveRow>& rows,
                                         std::string_view algorithm, const Criterion& criterion)
{
    std::map<double, LevelOfCurve> levels;
    for (const results::CurveRow& row : rows) {
        if (row.algorithm != algorithm) continue;
        LevelOfCurve& level = levels[row.level];
        level.is_unusable |= row.judged.tier == metrics::Tier::unusable;
        const auto value = row.judged.*criterion.value;
        const bool is_worse =
            value && (!level.value || (criterion.is_worse_when_less ? *value < *level.value
                                                                    : *value > *level.value));
        if (is_worse) level.value = value;
    }
    return levels;
}

/// Empty when none of the rows has this criterion.
std::string curve_plot(const std::vector<results::CurveRow>& rows, const Criterion& criterion,
                       const std::string& title, const std::optional<metrics::Criteria>& criteria)
{
    std::vector<plot::Curve> curves;
    plot::PlotOptions options{.scales = {.y = criterion.scale}, .size = {360.0, 250.0}};
    if (criteria) options.levels.push_back({criterion.threshold(*criteria), "usable"});
    const auto algorithms = distinct(rows, [](const auto& row) { return row.algorithm; });
    for (const std::string& algorithm : algorithms) {
        const auto colour = colour_of(algorithm);
        plot::Curve curve{.name = algorithm,
                          .colour = colour,
                          .width = curve_width(algorithm),
                          .shows_points = true};
        bool has_failed = false;
        for (const auto& [level, found] : levels_of(rows, algorithm, criterion)) {
            options.x.include(level);
            if (!found.value) continue;
            curve.points.push_back({level, *found.value});
            if (!found.is_unusable || has_failed) continue;
            options.crosses.push_back({curve.points.back(), colour});
            has_failed = true;
        }
        if (!curve.points.empty()) curves.push_back(std::move(curve));
    }
    if (curves.empty()) return "";
    const auto& first = rows.front();
    const std::string across =
        fmt::format("{}, {}", impairment_text(first.impairment), unit_text(first.unit));
    return plot::svg_plot({title, across, criterion.unit}, curves, options);
}

/// Without what an algorithm did beyond the first level at which a task failed: there the others
/// are no longer the worst of all tasks.
std::vector<results::CurveRow> up_to_failure(const std::vector<results::CurveRow>& rows)
{
    std::map<std::string, double> ends;
    for (const results::CurveRow& row : rows) {
        if (row.judged.tier != metrics::Tier::unusable) continue;
        const auto [found, is_new] = ends.emplace(row.algorithm, row.level);
        if (!is_new) found->second = std::min(found->second, row.level);
    }
    std::vector<results::CurveRow> kept;
    for (const results::CurveRow& row : rows) {
        const auto end = ends.find(row.algorithm);
        if (end == ends.end() || row.level <= end->second) kept.push_back(row);
    }
    return kept;
}

std::string by_task(const std::vector<results::CurveRow>& rows,
                    const std::optional<metrics::Criteria>& criteria)
{
    std::string out;
    for (const std::string& task : distinct(rows, [](const auto& row) { return row.task; })) {
        std::vector<results::CurveRow> of_task;
        for (const results::CurveRow& row : rows) {
            if (row.task == task) of_task.push_back(row);
        }
        for (const Criterion& criterion : criteria_drawn) {
            const auto title = fmt::format("{}: {}", task, criterion.name);
            const auto svg = curve_plot(of_task, criterion, title, criteria);
            if (!svg.empty()) out += figure(svg, escaped(title));
        }
    }
    return "<div class='panels small'>\n" + out + "</div>\n";
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
    std::string unmeasured;
    for (const Criterion& criterion : criteria_drawn) {
        if (!is_measured(rows, criterion)) {
            unmeasured += fmt::format("{}{}", unmeasured.empty() ? "" : ", ", criterion.name);
        }
        auto svg =
            curve_plot(up_to_failure(rows), criterion, std::string{criterion.title}, criteria);
        if (svg.empty()) continue;
        section.add_figure(fmt::format("curve-{}-{}", name, criterion.name), std::move(svg),
                           "Worst of tasks and seeds.");
    }
    section.html += "</div>\n";
    if (!unmeasured.empty()) {
        section.html += fmt::format("<p class='banner'>Not measured in any of these sessions, so "
                                    "no session can have failed by it: {}.</p>\n",
                                    unmeasured);
    }
    section.html += folded("Each task on its own", by_task(rows, criteria));
}

} // namespace

std::optional<Section> curves_section(const results::Results& results)
{
    if (results.curves.empty()) return std::nullopt;
    Section section{"curves", "The curves behind the limits",
                    "<p>Every point is the worst session that the search played at that level. "
                    "A cross marks the first level at which an algorithm fails, by whichever "
                    "criterion: beyond it only the other tasks were played, each on its own "
                    "below.</p>\n"};
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

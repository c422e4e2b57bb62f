// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/paired.hpp"
#include "lab/report/section.hpp"
#include "lab/report/words.hpp"

#include <algorithm>
#include <map>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

/// What is drawn against the level, and which way is worse.
struct Criterion {
    std::string_view name;
    std::string_view title;
    std::string_view unit;
    std::optional<double> results::Judged::*value;
    page::Scale scale;
    double (*threshold)(const metrics::Criteria&); // of what is usable
};

constexpr std::array criteria_drawn{
    Criterion{"vibration", "Vibration of the cube above 20 Hz", "mm",
              &results::Judged::vibration_mm, page::Scale::logarithmic,
              [](const metrics::Criteria& c) {
                  return 1e3 * at_order(c.usable.vibration_max_m, c.filter_order);
              }},
    Criterion{"stiffness", "Stiffness felt at 1 Hz", "of that at no delay",
              &results::Judged::stiffness_ratio, page::Scale::linear,
              [](const metrics::Criteria& c) { return c.usable.stiffness_ratio_min; }},
    Criterion{"force-vibration", "Vibration of the force above 20 Hz", "N",
              &results::Judged::force_vibration_n, page::Scale::logarithmic,
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

/// A point for each seed, and a line through the medians; nullopt when none of the rows has this
/// criterion.
std::optional<page::Figure> curve_figure(const std::vector<results::CurveRow>& rows,
                                         const Criterion& criterion,
                                         const std::optional<metrics::Criteria>& criteria)
{
    page::Curves content;
    if (criteria) content.levels.push_back({criterion.threshold(*criteria), "usable"});
    for (const auto& algorithm : distinct(rows, [](const auto& row) { return row.algorithm; })) {
        page::Curve curve{
            .name = algorithm, .colour = colour_of(algorithm), .width = curve_width(algorithm)};
        for (const auto& [level, values] : values_of(rows, algorithm, criterion)) {
            curve.points.push_back({level, metrics::median_of(values)});
            for (const double value : values) curve.scatter.push_back({level, value});
        }
        if (!curve.points.empty()) content.curves.push_back(std::move(curve));
    }
    if (content.curves.empty()) return std::nullopt;
    const std::string& impairment = rows.front().impairment;
    const std::string& task = rows.front().task;
    return page::Figure{
        .id = page::plain_id(fmt::format("curve-{}-{}-{}", impairment, task, criterion.name)),
        .title = fmt::format("{}: {}", task, criterion.name),
        .x = {impairment_text(impairment), std::string{unit_text(rows.front().unit)}},
        .y = {std::string{criterion.name}, std::string{criterion.unit}, criterion.scale},
        .content = std::move(content),
        .size = {360.0, 250.0},
        .caption = fmt::format("{}: {}", task, criterion.title)};
}

/// Every task on its own: a line through the worst of several would jump from one to another.
Json tasks_of(Section& section, const std::vector<results::CurveRow>& rows,
              const std::optional<metrics::Criteria>& criteria)
{
    Json figures = Json::array();
    for (const std::string& task : distinct(rows, [](const auto& row) { return row.task; })) {
        const auto of_task = rows_where(rows, [&](const auto& row) { return row.task == task; });
        for (const Criterion& criterion : criteria_drawn) {
            if (auto figure = curve_figure(of_task, criterion, criteria))
                figures.push_back(section.keep(*std::move(figure)));
        }
    }
    return figures;
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
    section.add(page::heading(impairment_text(rows.front().impairment)));
    section.add(page::panels("small", tasks_of(section, rows, criteria)));
    std::string unmeasured;
    for (const Criterion& criterion : criteria_drawn) {
        if (is_measured(rows, criterion)) continue;
        unmeasured += fmt::format("{}{}", unmeasured.empty() ? "" : ", ", criterion.name);
    }
    if (!unmeasured.empty()) {
        section.add(page::banner("", "Not measured in any of these sessions, so no session can "
                                     "have failed by it: " +
                                         unmeasured + "."));
    }
}

} // namespace

std::optional<Section> curves_section(const results::Results& results)
{
    if (results.curves.empty()) return std::nullopt;
    Section section{"curves", "The curves behind the limits"};
    section.add(page::paragraph("Every point is a session: all seeds at each level that counts. "
                                "The line joins their medians."));
    section.sources = files_named(results, "curves.csv");
    const auto criteria = results.criteria();
    if (criteria) section.add(page::paragraph("The dashed line is where usable ends."));
    for (const auto& name : distinct(results.curves, [](const auto& r) { return r.impairment; })) {
        const auto rows =
            rows_where(results.curves, [&](const auto& row) { return row.impairment == name; });
        add_curves(section, rows, criteria);
    }
    return section;
}

} // namespace hapnet::lab::report

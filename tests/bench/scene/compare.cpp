// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

constexpr std::array peer_families{"bullet", "ode", "mujoco"};

/// The smallest value of a family; nullopt when it has none.
std::optional<double> best_of(std::string_view family, std::span<const Reading> readings)
{
    std::optional<double> best;
    for (const Reading& one : readings) {
        if (one.family != family || !(one.value >= 0.0)) continue;
        best = std::min(best.value_or(one.value), one.value);
    }
    return best;
}

std::string number(double value)
{
    if (std::isnan(value)) return "–"; // it cannot run the scene
    const bool is_plain = std::abs(value) >= 1000.0 && std::abs(value) < 1e7;
    return is_plain ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
}

using Key = std::pair<std::string, std::string>; // case and metric

/// One line of a table.
struct Line {
    Key key;
    std::vector<std::pair<std::string, double>> values; // by subject
    std::string target;
    std::string verdict;

    [[nodiscard]] std::vector<std::string> columns() const
    {
        std::vector<std::string> names;
        for (const auto& [subject, value] : values) names.push_back(subject);
        return names;
    }
};

bool is_comparison(const Row& row) { return row.metric.ends_with("_ratio") && row.baseline_value; }

std::string metric_of(const Row& row)
{
    constexpr std::string_view suffix = "_ratio";
    return is_comparison(row) ? row.metric.substr(0, row.metric.size() - suffix.size())
                              : row.metric;
}

void add_word(std::string& text, const std::string& word)
{
    if (text.find(word) != std::string::npos) return;
    text += (text.empty() ? "" : ", ") + word;
}

void add(Line& line, const Row& row)
{
    const bool is_ratio = is_comparison(row);
    std::string said;
    if (is_ratio) {
        const std::string ratio = row.ratio() ? number(*row.ratio()) + "x" : "exact";
        said = fmt::format("{} {}", row.baseline, ratio);
    } else {
        line.values.emplace_back(row.subject, row.value);
    }
    if (row.target) {
        add_word(line.target,
                 fmt::format("{} {}{}", row.direction == Direction::at_least ? "≥" : "≤",
                             number(*row.target), is_ratio ? "x" : ""));
    }
    if (row.met() == false) said += said.empty() ? "**missed**" : " **missed**";
    if (!said.empty()) line.verdict += (line.verdict.empty() ? "" : ", ") + said;
}

std::string table_of(std::span<const Line> lines, const std::vector<std::string>& columns)
{
    std::string text = "| case | metric |", rule = "| --- | --- |";
    for (const std::string& column : columns) {
        text += fmt::format(" {} |", column);
        rule += " ---: |";
    }
    text += " target | best peer / Hapnet |\n" + rule + " --- | --- |\n";
    for (const Line& line : lines) {
        text += fmt::format("| {} | {} |", line.key.first, line.key.second);
        for (const auto& [subject, value] : line.values)
            text += fmt::format(" {} |", number(value));
        text += fmt::format(" {} | {} |\n", line.target, line.verdict);
    }
    return text;
}

} // namespace

std::vector<Row> compare(const Question& question, std::span<const Reading> readings)
{
    std::vector<Row> rows;
    for (const Reading& one : readings) {
        Row row{
            question.name,     one.subject, question.reference, question.metric, one.value, {}, {},
            question.direction};
        if (one.family == own_family) row.target = question.target;
        rows.push_back(std::move(row));
    }
    const auto own = std::find_if(readings.begin(), readings.end(),
                                  [](const Reading& one) { return one.family == own_family; });
    if (own == readings.end() || question.direction == Direction::at_least) return rows;
    for (const char* family : peer_families) {
        const auto best = best_of(family, readings);
        if (!best) continue;
        Row row{question.name, own->subject, family, question.metric + "_ratio",
                own->value,    best,         {},     Direction::at_least};
        if (question.ratio_min > 0.0) row.target = question.ratio_min;
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<Entry> entries_of(const Scenario& scenario, std::span<const Subject> subjects)
{
    std::vector<Entry> entries;
    for (const Subject& subject : subjects) {
        entries.push_back({subject.name, &subject, scenario.options});
        if (scenario.is_flight && subject.has_rk4) {
            entries.push_back({subject.name + " rk4", &subject, scenario.options});
            entries.back().options.integrator = Integrator::rk4;
        }
        if (!scenario.has_native || !subject.has_native_hips) continue;
        EngineOptions options = scenario.options;
        options.hip_force = HipForce::native;
        entries.push_back({subject.name + " native", &subject, options});
    }
    return entries;
}

std::vector<Reading> costs_of(const Course& course, std::span<const Entry> entries,
                              double seconds_each)
{
    std::vector<Contender> contenders;
    for (const Entry& one : entries) contenders.push_back({one.subject, one.options});
    const std::vector<double> costs = race(course, contenders, seconds_each);
    std::vector<Reading> readings;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        readings.push_back({entries[i].name, entries[i].subject->family, costs[i]});
    }
    return readings;
}

std::vector<Row> judge(const Scenario& scenario, std::span<const Subject> subjects,
                       double seconds_each)
{
    const std::vector<Entry> entries = entries_of(scenario, subjects);
    std::vector<Question> questions;
    std::map<std::string, std::vector<Reading>> readings; // by metric
    for (const Entry& one : entries) {
        const auto engine = one.subject->make(scenario.course.scene, one.options);
        if (!engine) continue;
        for (const Measure& measure :
             scenario.measure(*engine, scenario.course, one.options.tick_s)) {
            auto& all = readings[measure.metric];
            if (all.empty()) {
                questions.push_back(
                    {scenario.name, scenario.reference, measure.metric, measure.target});
            }
            all.push_back({one.name, one.subject->family, measure.value});
        }
    }
    std::vector<Row> rows;
    for (const Question& question : questions) {
        const auto some = compare(question, readings[question.metric]);
        rows.insert(rows.end(), some.begin(), some.end());
    }
    Question cost{scenario.name, "", "p50_ns", {}, scenario.cost_ratio_min};
    if (scenario.cost_ns_max > 0.0) cost.target = scenario.cost_ns_max;
    const auto some = compare(cost, costs_of(scenario.course, entries, seconds_each));
    rows.insert(rows.end(), some.begin(), some.end());
    return rows;
}

std::string markdown(std::span<const Row> rows)
{
    std::vector<Line> lines;
    for (const Row& row : rows) {
        const Key key{row.name, metric_of(row)};
        auto line = std::find_if(lines.begin(), lines.end(),
                                 [&](const Line& one) { return one.key == key; });
        if (line == lines.end()) line = lines.insert(lines.end(), Line{key, {}, "", ""});
        add(*line, row);
    }
    std::string text;
    while (!lines.empty()) { // cases with the same columns make one table
        const std::vector<std::string> columns = lines.front().columns();
        const auto rest = std::stable_partition(
            lines.begin(), lines.end(), [&](const Line& one) { return one.columns() == columns; });
        text += table_of({lines.begin(), rest}, columns) + "\n";
        lines.erase(lines.begin(), rest);
    }
    return text;
}

std::string misses(std::span<const Row> rows)
{
    std::string list;
    for (const Row& row : rows) {
        if (row.met() != false) continue;
        const bool is_ratio = is_comparison(row);
        const std::string value = is_ratio ? fmt::format("{} is {} times as much", row.baseline,
                                                         number(row.ratio().value_or(0.0)))
                                           : number(row.value);
        list += fmt::format("- {}, {}: {}, target {} {}\n", row.name, metric_of(row), value,
                            row.direction == Direction::at_least ? "≥" : "≤", number(*row.target));
    }
    return list.empty() ? "- none\n" : list;
}

} // namespace hapnet::bench

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/compare.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

constexpr std::array peer_families{"bullet", "ode"};

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

std::string number(std::optional<double> value)
{
    return value ? fmt::format("{:.3g}", *value) : "";
}

/// One line of a table.
struct Line {
    std::map<std::string, double> values; // by subject
    std::string target;
    std::string verdict;
};

void add(Line& line, const Row& row)
{
    if (row.metric.ends_with("_ratio") && row.baseline_value) {
        const std::string ratio = row.ratio() ? fmt::format("{:.3g}x", *row.ratio()) : "exact";
        line.verdict +=
            fmt::format("{}{} {}", line.verdict.empty() ? "" : ", ", row.baseline, ratio);
    } else {
        line.values[row.subject] = row.value;
    }
    if (!row.target) return;
    const bool is_ratio = row.metric.ends_with("_ratio");
    const std::string target =
        fmt::format("{}{:.3g}{}", row.direction == Direction::at_least ? "≥ " : "≤ ", *row.target,
                    is_ratio ? "x" : "");
    if (line.target.find(target) == std::string::npos) {
        line.target += (line.target.empty() ? "" : ", ") + target;
    }
    if (row.met() == false) line.verdict += is_ratio ? " **missed**" : " **missed** ";
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
        entries.push_back({subject.name, &subject, {}});
        if (!scenario.has_native || !subject.has_native_hips) continue;
        EngineOptions options;
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
    std::vector<std::string> subjects;
    std::vector<std::pair<std::string, std::string>> order; // case and metric
    std::map<std::pair<std::string, std::string>, Line> lines;
    for (const Row& row : rows) {
        std::string metric = row.metric;
        const bool is_ratio = metric.ends_with("_ratio") && row.baseline_value;
        if (is_ratio) metric.resize(metric.size() - std::string_view{"_ratio"}.size());
        const std::pair key{row.name, metric};
        if (!lines.contains(key)) order.push_back(key);
        add(lines[key], row);
        if (!is_ratio &&
            std::find(subjects.begin(), subjects.end(), row.subject) == subjects.end()) {
            subjects.push_back(row.subject);
        }
    }
    std::string text = "| case | metric |";
    std::string rule = "| --- | --- |";
    for (const std::string& subject : subjects) {
        text += fmt::format(" {} |", subject);
        rule += " ---: |";
    }
    text += " target | best peer / Hapnet |\n" + rule + " --- | --- |\n";
    for (const auto& key : order) {
        const Line& line = lines[key];
        text += fmt::format("| {} | {} |", key.first, key.second);
        for (const std::string& subject : subjects) {
            const auto found = line.values.find(subject);
            text += fmt::format(
                " {} |",
                number(found == line.values.end() ? std::nullopt : std::optional{found->second}));
        }
        text += fmt::format(" {} | {} |\n", line.target, line.verdict);
    }
    return text;
}

} // namespace hapnet::bench

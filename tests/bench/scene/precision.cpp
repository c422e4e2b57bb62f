// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/precision.hpp"

#include "tests/bench/scene/compare.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <spdlog/fmt/fmt.h>

namespace hapnet::bench {

namespace {

std::vector<Scenario> chosen()
{
    using scene::Turning;
    std::vector<Scenario> all{ballistic(),
                              slide(0.0, Turning::free),
                              slide(45.0, Turning::free),
                              bounce(1000.0, 0.0, Turning::locked),
                              squeezed_oscillation(Turning::locked),
                              tumble(),
                              off_centre_push()};
    for (Scenario& one : element_scenarios()) all.push_back(std::move(one));
    return all;
}

/// The power of the tick with which the errors grow, between the longest and the shortest.
std::string order_of(const std::map<double, double>& error_by_tick)
{
    constexpr double rounding = 1e-11;
    const auto& [short_ms, least] = *error_by_tick.begin();
    const auto& [long_ms, most] = *error_by_tick.rbegin();
    if (std::max(least, most) < rounding) return "exact";
    return fmt::format("{:.1f}", std::log(most / least) / std::log(long_ms / short_ms));
}

} // namespace

std::vector<WorkPoint> measure_precision(std::span<const Subject> subjects, bool is_quick)
{
    constexpr std::array ticks_ms{4.0, 2.0, 1.0, 0.5, 0.25};
    const double seconds_each = is_quick ? 0.01 : 0.1;
    std::vector<WorkPoint> points;
    for (const Scenario& scenario : chosen()) {
        std::vector<WorkPoint> of_scenario;
        for (const double tick_ms : ticks_ms) {
            Scenario held = scenario;
            held.has_native = false;
            held.options.tick_s = tick_ms * 1e-3;
            const std::vector<Entry> entries = entries_of(held, subjects);
            const auto costs = costs_of(scenario.course, entries, seconds_each);
            for (std::size_t i = 0; i < entries.size(); ++i) {
                const auto engine =
                    entries[i].subject->make(scenario.course.scene, entries[i].options);
                if (!engine) continue;
                const Measure measure =
                    scenario.measure(*engine, scenario.course, tick_ms * 1e-3).front();
                of_scenario.push_back({scenario.name, measure.metric, entries[i].name, tick_ms,
                                       measure.value, costs[i].value / tick_ms});
            }
        }
        std::stable_sort(of_scenario.begin(), of_scenario.end(),
                         [&](const auto& a, const auto& b) { return a.subject < b.subject; });
        points.insert(points.end(), of_scenario.begin(), of_scenario.end());
    }
    return points;
}

std::string precision_csv(std::span<const WorkPoint> points)
{
    std::string csv = "scenario,metric,subject,tick_ms,error,ns_per_simulated_ms\n";
    for (const WorkPoint& one : points) {
        csv += fmt::format("\"{}\",{},{},{:g},{:.6g},{:.6g}\n", one.scenario, one.metric,
                           one.subject, one.tick_ms, one.error, one.ns_per_simulated_ms);
    }
    return csv;
}

std::string precision_markdown(std::span<const WorkPoint> points)
{
    std::map<std::string, std::map<std::string, std::map<double, double>>> errors;
    std::set<std::string> subjects;
    for (const WorkPoint& one : points) {
        errors[one.scenario + " | " + one.metric][one.subject][one.tick_ms] = one.error;
        subjects.insert(one.subject);
    }
    std::string text = "| case | metric |", rule = "| --- | --- |";
    for (const std::string& subject : subjects) {
        text += fmt::format(" {} |", subject);
        rule += " ---: |";
    }
    text += "\n" + rule + "\n";
    for (const auto& [scenario, by_subject] : errors) {
        text += fmt::format("| {} |", scenario);
        for (const std::string& subject : subjects) {
            const auto found = by_subject.find(subject);
            text += found == by_subject.end() ? " – |"
                                              : fmt::format(" {:.2g} ({}) |", found->second.at(1.0),
                                                            order_of(found->second));
        }
        text += "\n";
    }
    return text;
}

} // namespace hapnet::bench

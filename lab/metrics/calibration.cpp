// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/calibration.hpp"

#include "lab/metrics/paired.hpp"
#include "lab/metrics/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <vector>

namespace hapnet::lab::metrics {

namespace {

constexpr double vibration_steps_per_m = 1e5;
constexpr double stiffness_steps = 1e3;

/// Returns the values of a number by task. Sessions without that number are left out.
template <typename Value>
std::map<device::Task, std::vector<double>> by_task(std::span<const Scores> sessions, Value value)
{
    std::map<device::Task, std::vector<double>> values;
    for (const Scores& scores : sessions) {
        if (const std::optional<double> one = value(scores)) values[scores.task].push_back(*one);
    }
    return values;
}

/// Returns the largest of the tasks' medians of the vibration.
std::optional<double> median_vibration(std::span<const Scores> sessions, double ByOrder::*order)
{
    std::optional<double> largest;
    const auto values = by_task(sessions, [&](const Scores& scores) {
        return scores.vibration_m ? std::optional{*scores.vibration_m.*order} : std::nullopt;
    });
    for (const auto& [task, of_task] : values) {
        const double median = median_of(of_task);
        largest = std::max(largest.value_or(median), median);
    }
    return largest;
}

/// Returns the largest of the tasks' medians of the stiffness error.
std::optional<double> median_stiffness_error(std::span<const Scores> sessions)
{
    std::optional<double> largest;
    const auto values =
        by_task(sessions, [](const Scores& scores) { return scores.slow_stiffness_error; });
    for (const auto& [task, of_task] : values) {
        const double median = median_of(of_task);
        largest = std::max(largest.value_or(median), median);
    }
    return largest;
}

double rounded(double value, double steps) { return std::round(value * steps) / steps; }

/// Returns the reason why more than half of a task's sessions fail whatever the two calibrated
/// limits are; nullopt: there is none.
std::optional<std::string> objection_to(std::span<const Scores> sessions, Criteria criteria)
{
    constexpr double none = std::numeric_limits<double>::infinity();
    criteria.usable.vibration_max_m = {none, none, none};
    criteria.usable.slow_stiffness_error_max = none;
    std::map<device::Task, std::pair<std::size_t, std::size_t>> counts; // failed sessions and all
    std::map<device::Task, std::string> reasons;
    for (const Scores& scores : sessions) {
        auto& [failed, all] = counts[scores.task];
        ++all;
        const Judgement judgement = judge(scores, criteria);
        if (judgement.failures.empty()) continue;
        ++failed;
        reasons[scores.task] = fmt::format("{}: {}", device::name_of(scores.task),
                                           fmt::join(judgement.failures, "; "));
    }
    for (const auto& [task, count] : counts) {
        if (2 * count.first > count.second) return reasons[task];
    }
    return std::nullopt;
}

} // namespace

base::Result<Criteria> calibrated(const CalibrationSessions& sessions, const Criteria& rest)
{
    const auto lossy = sessions.at_random_loss;
    const auto first = median_vibration(lossy, &ByOrder::first);
    const auto second = median_vibration(lossy, &ByOrder::second);
    const auto fourth = median_vibration(lossy, &ByOrder::fourth);
    const auto stiffness = median_stiffness_error(sessions.at_delay);
    if (!first || !second || !fourth) {
        return base::fail("no session under random loss tells of vibration");
    }
    if (!stiffness) return base::fail("no session under delay tells of stiffness: play T2");
    Criteria criteria = rest;
    criteria.usable.vibration_max_m = {.first = rounded(*first, vibration_steps_per_m),
                                       .second = rounded(*second, vibration_steps_per_m),
                                       .fourth = rounded(*fourth, vibration_steps_per_m)};
    criteria.usable.slow_stiffness_error_max = rounded(*stiffness, stiffness_steps);
    for (const auto& played : {sessions.at_delay, sessions.at_random_loss}) {
        const auto objection = objection_to(played, criteria);
        if (objection) {
            return base::fail("more than half of the sessions to calibrate on are not usable in "
                              "any case: " +
                              *objection);
        }
    }
    return criteria;
}

} // namespace hapnet::lab::metrics

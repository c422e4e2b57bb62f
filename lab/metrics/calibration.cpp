// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/calibration.hpp"

#include "lab/metrics/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::metrics {

namespace {

constexpr double vibration_steps_per_m = 1e5;
constexpr double stiffness_steps = 1e3;

std::optional<ByOrder> largest_vibration(std::span<const Scores> sessions)
{
    std::optional<ByOrder> largest;
    for (const Scores& scores : sessions) {
        if (!scores.vibration_m) continue;
        const ByOrder& value = *scores.vibration_m;
        if (!largest) largest = value;
        largest->first = std::max(largest->first, value.first);
        largest->second = std::max(largest->second, value.second);
        largest->fourth = std::max(largest->fourth, value.fourth);
    }
    return largest;
}

std::optional<double> least_stiffness(std::span<const Scores> sessions)
{
    std::optional<double> least;
    for (const Scores& scores : sessions) {
        const auto& ratio = scores.stiffness_ratio[judged_press];
        if (ratio) least = std::min(least.value_or(*ratio), *ratio);
    }
    return least;
}

double vibration_limit(double worst)
{
    return std::ceil(worst * vibration_steps_per_m) / vibration_steps_per_m;
}

/// What is not usable by these criteria, all the same.
std::optional<std::string> objection_to(std::span<const Scores> sessions, const Criteria& criteria)
{
    for (const Scores& scores : sessions) {
        const Judgement judgement = judge(scores, criteria);
        if (judgement.failures.empty()) continue;
        return fmt::format("{}: {}", device::name_of(scores.task),
                           fmt::join(judgement.failures, "; "));
    }
    return std::nullopt;
}

} // namespace

base::Result<Criteria> calibrated(const CalibrationSessions& sessions, const Criteria& rest)
{
    const auto vibration = largest_vibration(sessions.at_random_loss);
    const auto stiffness = least_stiffness(sessions.at_delay);
    if (!vibration) return base::fail("no session under random loss tells of vibration");
    if (!stiffness) return base::fail("no session under delay tells of stiffness: play T2");
    if (*stiffness * stiffness_steps < 1.0) {
        return base::fail(fmt::format("at the delay no stiffness is left: {:.3f}", *stiffness));
    }
    Criteria criteria = rest;
    criteria.usable.vibration_max_m = {.first = vibration_limit(vibration->first),
                                       .second = vibration_limit(vibration->second),
                                       .fourth = vibration_limit(vibration->fourth)};
    criteria.usable.stiffness_ratio_min =
        std::floor(*stiffness * stiffness_steps) / stiffness_steps;
    for (const auto& played : {sessions.at_delay, sessions.at_random_loss}) {
        const auto objection = objection_to(played, criteria);
        if (objection) {
            return base::fail("a session to calibrate on is not usable in any case: " + *objection);
        }
    }
    return criteria;
}

} // namespace hapnet::lab::metrics

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/fit.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::hands {

namespace {

/// The greatest scale at which a rule is kept.
struct Bound {
    double scale = std::numeric_limits<double>::infinity();
    std::string what{};

    void lower(double to, std::string_view by)
    {
        if (to < scale) *this = {to, std::string{by}};
    }
};

/// Returns how far A is to the right of B; for a single hand, of the scene's origin.
double reach_at(const std::vector<Motion>& hands, std::size_t i)
{
    return hands[0][i].x - (hands.size() > 1 ? hands[1][i].x : 0.0);
}

std::size_t meeting_of(const std::vector<Motion>& hands)
{
    std::size_t meeting = 0;
    for (std::size_t i = 1; i < hands[0].size(); ++i)
        if (reach_at(hands, i) > reach_at(hands, meeting)) meeting = i;
    return meeting;
}

/// Returns the place where the fit puts a hand at the meeting.
glm::dvec3 anchor_of(std::size_t hand, double press_m)
{
    const double x = touching_m - press_m;
    return {hand == 0 ? -x : x, 0.0, 0.0};
}

Bound bound_of(const std::vector<Motion>& hands, std::size_t meeting, const FitRules& rules)
{
    constexpr std::array<std::string_view, 3> along{"workspace along x", "workspace along y",
                                                    "workspace along z"};
    Bound bound;
    for (std::size_t hand = 0; hand < hands.size(); ++hand) {
        const glm::dvec3 anchor = anchor_of(hand, rules.press_m);
        for (const glm::dvec3& place : hands[hand]) {
            const glm::dvec3 away = place - hands[hand][meeting];
            for (const int axis : {0, 1, 2}) {
                if (away[axis] == 0.0) continue;
                const double end = std::copysign(half_workspace_m[axis], away[axis]);
                bound.lower((end - anchor[axis]) / away[axis],
                            along.at(static_cast<std::size_t>(axis)));
            }
        }
        const double speed = speed_max_of(hands[hand]);
        if (speed > 0.0) bound.lower(rules.speed_max_m_per_s / speed, "speed");
    }
    return bound;
}

double mean_reach_of(const std::vector<Motion>& hands)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < hands[0].size(); ++i) sum += reach_at(hands, i);
    return sum / static_cast<double>(hands[0].size());
}

/// Rounds down to four digits, so that the result does not exceed the bound.
double rounded_down(double scale)
{
    const double per_unit = std::pow(10.0, 3.0 - std::floor(std::log10(scale)));
    return std::floor(scale * per_unit) / per_unit;
}

double touching_share_of(const std::vector<Motion>& hands)
{
    const double from_m = hands.size() > 1 ? -2.0 * touching_m : -touching_m;
    std::size_t touching = 0;
    for (std::size_t i = 0; i < hands[0].size(); ++i)
        touching += reach_at(hands, i) >= from_m ? 1U : 0U;
    return static_cast<double>(touching) / static_cast<double>(hands[0].size());
}

} // namespace

base::Result<Fit> fit(std::vector<Motion>& hands, const FitRules& rules)
{
    base::ensure(!hands.empty() && !hands[0].empty());
    if (hands.size() > 1 && mean_reach_of(hands) >= 0.0) {
        return base::fail("A's hand is on the right of B's in the mean: name B's file first, or "
                          "choose other --axes, such as -x,y,-z");
    }
    const std::size_t meeting = meeting_of(hands);
    const Bound bound = bound_of(hands, meeting, rules);
    Fit found{.meeting_s = static_cast<double>(meeting) / motion_rate_hz};
    if (rules.scale && *rules.scale > bound.scale) {
        return base::fail(fmt::format("--scale {}: the {} does not allow more than {}: use that, "
                                      "or --scale fit",
                                      *rules.scale, bound.what, rounded_down(bound.scale)));
    }
    if (rules.scale) {
        found.scale = *rules.scale;
    } else if (bound.scale < 1.0) {
        found.scale = rounded_down(bound.scale);
        found.limited_by = bound.what;
    }
    for (std::size_t hand = 0; hand < hands.size(); ++hand) {
        const glm::dvec3 anchor = anchor_of(hand, rules.press_m);
        const glm::dvec3 met = hands[hand][meeting];
        for (glm::dvec3& place : hands[hand]) place = anchor + found.scale * (place - met);
    }
    found.touching_share = touching_share_of(hands);
    return found;
}

} // namespace hapnet::lab::hands

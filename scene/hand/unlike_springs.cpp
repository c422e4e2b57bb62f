// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/unlike_springs.hpp"

#include <array>
#include <cmath>

namespace hapnet::scene {

/// Sums the series. With d_n = d^(n)(0) tick^n / n! and f_n defined the same way, d_(n+2) = -tick^2
/// G f_n / ((n+1) (n+2)). The integrals of the force are the sums of f_n / (n+1) and of f_n /
/// ((n+1) (n+2)). The sum of all |f_n| but the first bounds the change of the force.
std::optional<PressedModes::Outcome> UnlikeSprings::outcome(const PressedModes::Start& start) const
{
    using Each = std::array<double, 2>;
    const double square = tick * tick;
    Each next{}, damper{}, force{}, response{}, driven{};
    Each once{}, twice{}, change{};
    double size = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
        next[i] = tick * start.speed[i];
        damper[i] = damping[i] / tick;
        response[i] = square * own[i];
        driven[i] = 0.5 * square * start.acceleration[i];
        constexpr double calm = 0.5;
        if (!(response[i] * (stiffness[i] + damper[i]) <= calm)) return std::nullopt;
        force[i] = stiffness[i] * start.depth[i] + damper[i] * next[i];
        size += std::abs(force[i]);
    }
    constexpr std::size_t series_max = 24;
    constexpr double rounding = 1e-14; // the terms after two such terms are less
    const double converged = rounding * size;
    double last = size;
    for (std::size_t n = 0; n < series_max; ++n) {
        const double order = static_cast<double>(n + 2);
        Each step{};
        for (std::size_t i = 0; i < 2; ++i) {
            step[i] = force[i] / (order * (order - 1.0));
            twice[i] += step[i];
            once[i] += order * step[i];
        }
        double now = 0.0;
        for (std::size_t i = 0; i < 2; ++i) {
            const double then = driven[i] - response[i] * step[i] - square * mutual * step[1 - i];
            driven[i] = 0.0;
            force[i] = stiffness[i] * next[i] + order * (damping[i] / tick) * then;
            next[i] = then;
            change[i] += std::abs(force[i]);
            now += std::abs(force[i]);
        }
        if (last + now <= converged) {
            return PressedModes::Outcome{Two{tick * once[0], tick * once[1]},
                                         Two{square * twice[0], square * twice[1]},
                                         Two{change[0], change[1]}};
        }
        last = now;
    }
    return std::nullopt;
}

} // namespace hapnet::scene

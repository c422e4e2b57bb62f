// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hapnet::scene {

/// A second implementation of the physics: one axis, Runge and Kutta's fourth order in small steps,
/// and bisection of a step in which anything changes its mode.
class Reference {
public:
    struct Hand {
        double sign;   // of the face's normal
        double centre; // at time 0
        double speed;
    };
    double mass = 0.1, drag = 0.0, stiffness = 500.0, damping = 2.0, force_max = 1e9;
    double touching = 0.025;              // between centres
    double friction = 0.0;                // newtons, the greatest
    double wall = 1e9, restitution = 0.0; // it is stopped at x = wall
    double x = 0.0, v = 0.0, time = 0.0;
    std::vector<Hand> hands;

    void run(double until, double step)
    {
        while (time < until) {
            const Modes modes = modes_at(x, v, time);
            double h = std::min(step, until - time);
            auto end = moved(modes, h);
            if (modes_at(end[0], end[1], time + h) != modes) {
                double low = 0.0;
                while (h - low > 1e-15) {
                    const double middle = 0.5 * (low + h);
                    if (middle == low || middle == h) break;
                    const auto there = moved(modes, middle);
                    (modes_at(there[0], there[1], time + middle) == modes ? low : h) = middle;
                }
                end = moved(modes, h);
                if (friction > 0.0 && end[1] * v < 0.0) end[1] = 0.0;
            }
            x = end[0];
            v = end[1];
            time += h;
            if (x > wall && v > 0.0) {
                x = wall;
                v = -restitution * v;
            }
        }
    }

private:
    /// For each hand: 0 apart, 1 slack, 2 active, 3 limited. Then the direction of the friction (2:
    /// it holds), and whether the box is in the wall.
    using Modes = std::vector<int>;

    [[nodiscard]] double depth(const Hand& hand, double at_x, double t) const
    {
        return touching - hand.sign * (hand.centre + hand.speed * t - at_x);
    }
    [[nodiscard]] double tension(const Hand& hand, double at_x, double at_v, double t) const
    {
        return stiffness * depth(hand, at_x, t) + damping * hand.sign * (at_v - hand.speed);
    }
    [[nodiscard]] Modes modes_at(double at_x, double at_v, double t) const
    {
        Modes modes;
        for (const Hand& hand : hands) {
            const double wanted = tension(hand, at_x, at_v, t);
            modes.push_back(depth(hand, at_x, t) <= 0.0 ? 0
                            : wanted <= 0.0             ? 1
                            : wanted < force_max        ? 2
                                                        : 3);
        }
        modes.push_back(0);
        modes.push_back(at_x > wall ? 1 : 0);
        if (friction > 0.0) {
            Modes smooth = modes;
            const double push = mass * acceleration(smooth, at_x, 0.0, t);
            const int holds = std::abs(push) <= friction ? 2 : (push > 0.0 ? 1 : -1);
            modes[hands.size()] = at_v == 0.0 ? holds : (at_v > 0.0 ? 1 : -1);
        }
        return modes;
    }
    [[nodiscard]] double acceleration(const Modes& modes, double at_x, double at_v, double t) const
    {
        const int dry_friction = modes[hands.size()];
        if (dry_friction == 2) return 0.0;
        double force = -drag * at_v - dry_friction * friction;
        for (std::size_t i = 0; i < hands.size(); ++i) {
            if (modes[i] == 2) force -= hands[i].sign * tension(hands[i], at_x, at_v, t);
            if (modes[i] == 3) force -= hands[i].sign * force_max;
        }
        return force / mass;
    }
    [[nodiscard]] std::array<double, 2> moved(const Modes& modes, double h) const
    {
        const double k1 = acceleration(modes, x, v, time);
        const double v2 = v + 0.5 * h * k1;
        const double k2 = acceleration(modes, x + 0.5 * h * v, v2, time + 0.5 * h);
        const double v3 = v + 0.5 * h * k2;
        const double k3 = acceleration(modes, x + 0.5 * h * v2, v3, time + 0.5 * h);
        const double v4 = v + h * k3;
        const double k4 = acceleration(modes, x + h * v3, v4, time + h);
        return {x + h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4),
                v + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)};
    }
};

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/maths/first_root.hpp"

namespace hapnet::scene {

namespace {

constexpr int steps_max = 200;

struct Sample {
    double value, rate, second_derivative;
    double second_derivative_max; // greatest |second_derivative| from this time on
};

Sample sample(const WatchedQuantity& watched, const Trajectories& trajectories, double time,
              double to)
{
    Sample s{watched.level + watched.slope * time, watched.slope, 0.0, 0.0};
    for (std::size_t i = 0; i < trajectories.size(); ++i) {
        const Trajectory& trajectory = trajectories[i];
        const double p = watched.displacement_weight[i];
        const double q = watched.speed_weight[i];
        if ((p == 0.0 && q == 0.0) || !trajectory.moves()) continue;
        const TrajectoryPoint motion = trajectory.after(time);
        const double acceleration = trajectory.acceleration(time, motion);
        const double jerk = trajectory.jerk(acceleration, motion.speed);
        const Bounds most = bounds(*trajectory.propagator, acceleration, jerk, to - time);
        s.value += p * motion.displacement + q * motion.speed;
        s.rate += p * motion.speed + q * acceleration;
        s.second_derivative += p * acceleration + q * jerk;
        s.second_derivative_max += std::abs(p) * most.acceleration + std::abs(q) * most.jerk;
    }
    return s;
}

/// Returns the longest time for which value + rate t - bend_max t^2 / 2 stays positive, for value
/// >= 0.
double safe_step(double value, const Sample& s)
{
    const double root = std::sqrt(s.rate * s.rate + 2.0 * value * s.second_derivative_max);
    if (s.rate < 0.0) return 2.0 * value / (root - s.rate);
    if (s.second_derivative_max > 0.0) return (s.rate + root) / s.second_derivative_max;
    return std::numeric_limits<double>::infinity();
}

} // namespace

RootSearch search_root(const WatchedQuantity& watched, const Trajectories& trajectories,
                       double from, double to, int& steps_left)
{
    using End = RootSearch::End;
    constexpr double near = 1e-14; // share of the time searched: the root counts as reached
    constexpr double flat = 1e-9;  // share of the greatest second derivative that counts as none
    const double nearest = near * (to - from);

    double time = from;
    Sample s = sample(watched, trajectories, time, to);
    if (s.value <= 0.0 || watched.leaves_zero) {
        const bool falls = s.rate < 0.0 ||
                           (s.rate == 0.0 && s.second_derivative < -flat * s.second_derivative_max);
        if (!watched.leaves_zero && falls) return {End::found, time};
        // The quantity rises from 0: the search continues a moment later.
        if (watched.leaves_zero || safe_step(0.0, s) <= nearest) {
            time = from + (to - from) / 1024.0;
            s = sample(watched, trajectories, time, to);
            if (s.value < 0.0) return {End::found, time};
        }
    }
    const int last = std::max(steps_left - steps_max, 0);
    for (; steps_left > last; --steps_left) {
        const double step = safe_step(std::max(s.value, 0.0), s);
        if (time + step >= to) return {};
        if (step <= nearest) return {End::found, time};
        time += step;
        s = sample(watched, trajectories, time, to);
    }
    return {End::given_up, time};
}

std::optional<double> first_root(const WatchedQuantity& watched, const Trajectories& trajectories,
                                 double from, double to)
{
    int steps = steps_max;
    const RootSearch search = search_root(watched, trajectories, from, to, steps);
    if (search.end == RootSearch::End::none) return std::nullopt;
    if (search.end == RootSearch::End::found) return search.time;
    // Hundreds of periods in one tick, and no root so far: only the sign at the end counts.
    const bool is_below = sample(watched, trajectories, to, to).value < 0.0;
    return is_below ? std::optional{search.time} : std::nullopt;
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/hand/spring.hpp"

namespace hapnet::scene {

namespace {

/// The part of [from, to] in which level + slope t is positive.
struct Interval {
    double from, to;
};

Interval positive(double level, double slope, Interval within)
{
    if (slope == 0.0) return level > 0.0 ? within : Interval{within.from, within.from};
    const double root = std::clamp(-level / slope, within.from, within.to);
    return slope > 0.0 ? Interval{root, within.to} : Interval{within.from, root};
}

/// Returns the integral of level + slope t.
double integral(double level, double slope, Interval over)
{
    return (over.to - over.from) * (level + 0.5 * slope * (over.from + over.to));
}

} // namespace

double impulse_at_constant_velocity(const HandDescription& hands, double depth, double closing,
                                    double time)
{
    const double level = hands.stiffness_n_per_m * depth + hands.damping_ns_per_m * closing;
    const double slope = hands.stiffness_n_per_m * closing;
    const Interval overlap = positive(depth, closing, {0.0, time});
    const Interval pushing = positive(level, slope, overlap);
    double impulse = integral(level, slope, pushing);
    const double over = level - hands.force_max_n;
    if (std::max(over + slope * pushing.from, over + slope * pushing.to) > 0.0) {
        impulse -= integral(over, slope, positive(over, slope, pushing));
    }
    return impulse;
}

} // namespace hapnet::scene

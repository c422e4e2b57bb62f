// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/bodies.hpp"

#include "lab/metrics/angle.hpp"
#include "lab/metrics/worse.hpp"

#include <cmath>
#include <cstddef>

namespace hapnet::lab::metrics {

namespace {

using virtual_time::Pose;
using virtual_time::Trace;

/// Returns the spread for the pair of sides whose mean is largest. `distance(a, b, i)` is the
/// distance between the sides a and b at sample i.
template <typename Distance>
std::optional<Spread> widest_spread(const Trace& trace, const Distance& distance)
{
    std::optional<Spread> widest;
    const std::size_t count = trace.sides.front().size();
    std::vector<double> distances(count);
    for (std::size_t a = 0; a < trace.sides.size(); ++a) {
        for (std::size_t b = a + 1; b < trace.sides.size(); ++b) {
            for (std::size_t i = 0; i < count; ++i) distances[i] = distance(a, b, i);
            const auto spread = spread_of(distances);
            if (!widest || (spread && !(spread->mean <= widest->mean))) widest = spread;
        }
    }
    return widest;
}

/// Returns the position and the orientation of one of the bodies in a side's sample.
Pose pose_of(const Trace& trace, std::size_t side, std::size_t sample, std::size_t body)
{
    if (body > 0) return trace.further[side][sample * trace.further_bodies + body - 1];
    const virtual_time::Sample& first = trace.sides[side][sample];
    return {first.body, first.orientation};
}

bool is_turned_by_any(const Trace& trace, std::size_t body)
{
    for (std::size_t side = 0; side < trace.sides.size(); ++side) {
        const glm::dquat first = pose_of(trace, side, 0, body).orientation;
        for (std::size_t i = 0; i < trace.sides[side].size(); ++i)
            if (pose_of(trace, side, i, body).orientation != first) return true;
    }
    return false;
}

/// Returns the spread of the body whose mean is largest.
std::optional<Spread> widest_of(const std::vector<BodyApart>& bodies,
                                std::optional<Spread> BodyApart::*spread)
{
    std::optional<Spread> widest;
    for (const BodyApart& body : bodies) widest = worse(widest, body.*spread);
    return widest;
}

BodyApart body_apart(const Trace& trace, std::size_t body)
{
    BodyApart apart;
    const auto way = [&](std::size_t a, std::size_t b, std::size_t i) {
        return pose_of(trace, a, i, body).position - pose_of(trace, b, i, body).position;
    };
    apart.discrepancy_x_m = widest_spread(trace, [&](std::size_t a, std::size_t b, std::size_t i) {
        return std::abs(way(a, b, i).x());
    });
    apart.discrepancy_m = widest_spread(trace, [&](std::size_t a, std::size_t b, std::size_t i) {
        return base::norm(way(a, b, i));
    });
    const bool turns = is_turned_by_any(trace, body);
    if (turns) {
        apart.turned_apart_rad =
            widest_spread(trace, [&](std::size_t a, std::size_t b, std::size_t i) {
                return angle_between(pose_of(trace, a, i, body).orientation,
                                     pose_of(trace, b, i, body).orientation);
            });
    }
    if (body < trace.settled.size()) {
        apart.settled_m = trace.settled[body].metres;
        if (turns) apart.settled_rad = trace.settled[body].radians;
    }
    return apart;
}

} // namespace

std::vector<BodyApart> bodies_apart(const Trace& trace)
{
    std::vector<BodyApart> bodies;
    for (std::size_t body = 0; body <= trace.further_bodies; ++body)
        bodies.push_back(body_apart(trace, body));
    return bodies;
}

std::optional<Spread> widest_discrepancy_x(const std::vector<BodyApart>& bodies)
{
    return widest_of(bodies, &BodyApart::discrepancy_x_m);
}

std::optional<Spread> widest_turned_apart(const std::vector<BodyApart>& bodies)
{
    return widest_of(bodies, &BodyApart::turned_apart_rad);
}

} // namespace hapnet::lab::metrics

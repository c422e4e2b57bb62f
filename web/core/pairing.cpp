// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/pairing.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::web {

void Track::add(const Sample& sample)
{
    if (!samples_.empty() && sample.at <= samples_.back().at) {
        if (sample.at == samples_.back().at) return; // the peer's loop has made no tick since
        samples_.clear();
    }
    samples_.push_back(sample);
    while (samples_.size() > samples_max || samples_.front().at < sample.at - kept) {
        samples_.pop_front();
    }
}

std::optional<base::TimePoint> Track::newest() const
{
    if (samples_.empty()) return std::nullopt;
    return samples_.back().at;
}

std::optional<glm::dvec3> Track::at(base::TimePoint time) const
{
    const auto after =
        std::lower_bound(samples_.begin(), samples_.end(), time,
                         [](const Sample& one, base::TimePoint wanted) { return one.at < wanted; });
    if (after == samples_.end()) return std::nullopt;
    if (after->at == time) return after->position;
    if (after == samples_.begin()) return std::nullopt;
    const Sample& p = *std::prev(after);
    const Sample& q = *after;
    if (q.at - p.at > gap_max) return std::nullopt;
    const double h = base::to_seconds(q.at - p.at);
    const double u = base::to_seconds(time - p.at) / h;
    const double v = 1.0 - u;
    return (1.0 + 2.0 * u) * v * v * p.position + u * v * v * h * p.velocity +
           u * u * (3.0 - 2.0 * u) * q.position - u * u * v * h * q.velocity;
}

double Apart::along_x_m() const { return std::abs(a.x - b.x); }
double Apart::distance_m() const { return glm::distance(a, b); }

std::optional<Apart> apart(const Track& a, const Track& b, base::Duration ahead)
{
    const auto newest_a = a.newest();
    const auto newest_b = b.newest();
    if (!newest_a || !newest_b) return std::nullopt;
    const base::TimePoint at = std::min(*newest_a, *newest_b - ahead);
    const auto place_a = a.at(at);
    const auto place_b = b.at(at + ahead);
    if (!place_a || !place_b) return std::nullopt;
    return Apart{at, *place_a, *place_b};
}

} // namespace hapnet::web

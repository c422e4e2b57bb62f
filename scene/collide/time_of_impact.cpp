// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/time_of_impact.hpp"

#include "scene/collide/manifold.hpp"
#include "scene/collide/pose.hpp"
#include "scene/collide/round.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

// Squared sine of the angle below which a cross product is only rounding errors.
constexpr double parallel_edges = 1e-16;
// The rounding error of a shadow's length, relative to it. Shadows that overlap by less only touch.
constexpr double rounding = 1e-13;

/// The time in which the shadows overlap along all axes tested so far: from `enter` to `leave`.
class Sweep {
public:
    Sweep(const OrientedBox& a, const OrientedBox& b, const glm::dvec3& relative_velocity)
        : a_{a},
          b_{b},
          offset_{b.centre - a.centre},
          velocity_{relative_velocity},
          speed_error_{rounding * std::sqrt(glm::dot(relative_velocity, relative_velocity))}
    {}

    /// Tests one more axis, of any length. Returns false when the boxes do not meet because of it.
    bool consider(const glm::dvec3& direction)
    {
        const double reach = half_projection(a_, direction) + half_projection(b_, direction);
        const double place = glm::dot(direction, offset_);
        const double speed = glm::dot(direction, velocity_);
        const double apart = std::abs(place) - reach;
        const double approach = place < 0.0 ? speed : -speed;
        const double error = rounding * (std::abs(place) + reach);
        const bool overlap = apart < -error;
        if (!overlap) {
            const double length =
                std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
            if (approach <= speed_error_ * length) return false; // sliding, or moving apart
            enter(std::max(apart, 0.0) / approach, error / approach, direction);
        }
        if (approach != 0.0) {
            const double through = approach > 0.0 ? std::abs(place) : -std::abs(place);
            leave_ = std::min(leave_, (reach + through) / std::abs(speed));
        }
        return enter_ < leave_;
    }

    [[nodiscard]] std::optional<TimeOfImpact> impact(double time_max) const
    {
        if (!is_touching_ || enter_ > time_max) return std::nullopt;
        const glm::dvec3 unit = normal_ / std::sqrt(glm::dot(normal_, normal_));
        return TimeOfImpact{.time = enter_,
                            .normal = glm::dot(unit, velocity_) > 0.0 ? -unit : unit};
    }

private:
    /// Sets the time of entry along an axis. A later axis always sets the time, but it sets the
    /// normal only if it is later by more than rounding. Of axes that meet at the same time the
    /// first one keeps the normal.
    void enter(double time, double error, const glm::dvec3& direction)
    {
        if (!is_touching_ || time > enter_ + error) normal_ = direction;
        enter_ = std::max(enter_, time);
        is_touching_ = true;
    }

    const OrientedBox& a_;
    const OrientedBox& b_;
    glm::dvec3 offset_;
    glm::dvec3 velocity_;
    double speed_error_;
    bool is_touching_ = false;
    double enter_ = 0.0;
    double leave_ = HUGE_VAL;
    glm::dvec3 normal_{0.0};
};

/// Calls visit(gap) for all 15 axes along which two boxes may be apart.
template <typename Visit>
void for_axes(const OrientedBox& a, const OrientedBox& b, Visit visit)
{
    const glm::dvec3 offset = b.centre - a.centre;
    const auto consider = [&](const glm::dvec3& normal) {
        const double place = glm::dot(normal, offset);
        const double distance =
            std::abs(place) - (half_projection(a, normal) + half_projection(b, normal));
        visit(Gap{distance, place < 0.0 ? -normal : normal});
    };
    for (const int i : {0, 1, 2}) consider(a.axes[i]);
    for (const int j : {0, 1, 2}) consider(b.axes[j]);
    for (const int i : {0, 1, 2}) {
        for (const int j : {0, 1, 2}) {
            const glm::dvec3 direction = glm::cross(a.axes[i], b.axes[j]);
            const double square = glm::dot(direction, direction);
            if (square >= parallel_sine2) consider(direction / std::sqrt(square));
        }
    }
}

} // namespace

std::optional<TimeOfImpact> time_of_impact(const OrientedBox& a, const OrientedBox& b,
                                           const glm::dvec3& relative_velocity, double time_max)
{
    if (a.is_round() || b.is_round())
        return round_time_of_impact(a, b, relative_velocity, time_max);
    Sweep sweep{a, b, relative_velocity};
    for (const int i : {0, 1, 2})
        if (!sweep.consider(a.axes[i])) return std::nullopt;
    for (const int j : {0, 1, 2})
        if (!sweep.consider(b.axes[j])) return std::nullopt;
    for (const int i : {0, 1, 2}) {
        for (const int j : {0, 1, 2}) {
            const glm::dvec3 direction = glm::cross(a.axes[i], b.axes[j]);
            if (glm::dot(direction, direction) < parallel_edges) continue;
            if (!sweep.consider(direction)) return std::nullopt;
        }
    }
    return sweep.impact(time_max);
}

Gap gap_between(const OrientedBox& a, const OrientedBox& b)
{
    if (a.is_round() || b.is_round()) return round_gap(a, b);
    Gap widest{-HUGE_VAL, {}};
    for_axes(a, b, [&](const Gap& gap) {
        if (gap.distance > widest.distance) widest = gap;
    });
    return widest;
}

Gap gap_between(const PlaneSurface& plane, const OrientedBox& box)
{
    return {glm::dot(plane.normal, box.centre) - plane.offset - half_extent(box, plane.normal),
            plane.normal};
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/time_of_impact.hpp"

#include "scene/collide/manifold.hpp"
#include "scene/collide/round.hpp"
#include "scene/maths/rotation.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

// Squared sine of the angle below which a cross product is only rounding errors.
constexpr double parallel_edges = 1e-16;
// Rounding errors of a shadow's length, relative to it: shadows that overlap by less touch.
constexpr double rounding = 1e-13;

/// While the shadows overlap along all axes so far: from `enter` to `leave`.
class Sweep {
public:
    Sweep(const OrientedBox& a, const OrientedBox& b, const glm::dvec3& relative_velocity)
        : a_{a},
          b_{b},
          offset_{b.centre - a.centre},
          velocity_{relative_velocity},
          speed_error_{rounding * std::sqrt(glm::dot(relative_velocity, relative_velocity))}
    {}

    /// One more axis, of any length; false when the boxes do not meet because of it.
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
            if (approach <= speed_error_ * length) return false; // sliding along it, or leaving
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
    /// A later axis decides the time when it is later at all, but the normal only when it is later
    /// by more than rounding: of axes that meet together the first stands.
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

// Squared sine of the angle below which two edges count as parallel: the faces tell enough then.
constexpr double parallel_sine2 = 1e-6;
// The share of the rest of the time that one axis should clear, before others are asked.
constexpr double worthwhile = 0.25;

/// How far a turning box reaches along a normal from its centre, and how that changes: at most
/// sum |reach + t speed| + t^2 bend / 2 after a time t.
struct Reach {
    glm::dvec3 reach{0.0}; // m, of the half edges
    glm::dvec3 speed{0.0}; // m/s
    double bend = 0.0;     // m/s^2
    double sphere = 0.0;   // m: never more than this
};

Reach reach_along(const glm::dvec3& normal, const OrientedBox& box, const SteadyBox& motion)
{
    const glm::dvec3 half = box.half - box.rounding; // of a round body's core
    const double radius = motion.radius - box.rounding;
    Reach reach{.reach = half * (normal * box.axes)};
    reach.sphere = sum_of_sizes(reach.reach);
    if (motion.spin == glm::dvec3{0.0}) return reach;
    reach.speed = half * (glm::cross(normal, motion.spin) * box.axes);
    reach.bend = glm::dot(motion.spin, motion.spin) * radius;
    reach.sphere = radius;
    return reach;
}

/// What is known of the gap along one normal from one moment on.
struct Forecast {
    double room = 0.0;     // m: how much the gap may shrink
    double approach = 0.0; // m/s: how fast the centres come nearer
    Reach a;
    Reach b;

    /// At least so much is left of the room.
    [[nodiscard]] double room_after(double time) const
    {
        const auto farther = [&](const Reach& its) {
            return sum_of_sizes(its.reach + time * its.speed) - sum_of_sizes(its.reach) +
                   0.5 * time * time * its.bend;
        };
        return room - time * approach - farther(a) - farther(b);
    }

    /// For how long there surely is room.
    [[nodiscard]] double time_left(double most) const
    {
        // What spins beside something comes no nearer than the sphere around it.
        const double beside =
            room + sum_of_sizes(a.reach) - a.sphere + sum_of_sizes(b.reach) - b.sphere;
        double left = 0.0;
        if (beside > 0.0) left = approach > 0.0 ? beside / approach : most;
        if (left >= most || room_after(most) >= 0.0) return most;
        // What is left of the room is concave in time: it is used up once, between these two.
        double enough = 0.0;
        double much = most;
        constexpr int halvings = 12;
        for (int i = 0; i < halvings && !(enough > 0.75 * much); ++i) {
            // First where it would be used up at the speed of the beginning.
            const double middle = i == 0 ? first_guess(most) : 0.5 * (enough + much);
            (room_after(middle) >= 0.0 ? enough : much) = middle;
        }
        const double fastest = approach + sum_of_sizes(a.speed) + sum_of_sizes(b.speed) +
                               0.5 * most * (a.bend + b.bend);
        return std::max({left, enough, fastest > 0.0 ? room / fastest : most});
    }

private:
    [[nodiscard]] double first_guess(double most) const
    {
        const double tiny = 1e-3 * most;
        const double used = room - room_after(tiny);
        return used > 0.0 ? std::min(0.5 * most, tiny * room / used) : 0.5 * most;
    }
};

/// Calls visit(gap) for all 15 axes along which two boxes may be apart; for round bodies, for the
/// one along which they are.
template <typename Visit>
void for_axes(const OrientedBox& a, const OrientedBox& b, Visit visit)
{
    if (a.is_round() || b.is_round()) return visit(round_gap(a, b));
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

/// Whether two spheres never come near each other: which most do not.
bool spheres_miss(const SteadyBox& a, const SteadyBox& b, const GapSearch& search)
{
    const glm::dvec3 velocity = b.velocity - a.velocity;
    const glm::dvec3 offset = b.centre - a.centre + search.from * velocity;
    const double square = glm::dot(velocity, velocity);
    const double along = -glm::dot(offset, velocity);
    double time = search.to - search.from;
    if (along < time * square) time = along > 0.0 ? along / square : 0.0;
    const glm::dvec3 nearest = offset + time * velocity;
    const double reach = a.radius + b.radius;
    return glm::dot(nearest, nearest) > reach * reach;
}

template <typename Look>
Advanced advance_by(const GapSearch& search, std::uint32_t& steps, Look look)
{
    double time = search.from;
    while (time < search.to) {
        if (steps == 0) return {time, Advanced::End::unfinished};
        --steps;
        const double left = look(time, search.to - time);
        if (left <= 0.0) return {time, Advanced::End::reached};
        time += left;
    }
    return {search.to, Advanced::End::clear};
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

OrientedBox SteadyBox::at(double time) const
{
    return {centre + time * velocity,
            axes_of(spin == glm::dvec3{0.0} ? orientation : rotated(orientation, time * spin)),
            half, rounding};
}

Advanced advance_to_gap(const SteadyBox& a, const SteadyBox& b, const GapSearch& search,
                        std::uint32_t& steps)
{
    if (spheres_miss(a, b, search)) return {search.to, Advanced::End::clear};
    return advance_by(search, steps, [&](double time, double most) {
        const OrientedBox box_a = a.at(time);
        const OrientedBox box_b = b.at(time);
        std::array<Gap, 15> open; // those that are wider than asked for
        std::size_t count = 0;
        std::size_t widest = 0;
        for_axes(box_a, box_b, [&](const Gap& gap) {
            if (gap.distance - search.gap <= search.near) return;
            if (count == 0 || gap.distance > open[widest].distance) widest = count;
            open[count++] = gap;
        });
        if (count == 0) return 0.0;
        const auto time_left = [&](const Gap& gap) {
            const Forecast now{
                gap.distance - search.gap, glm::dot(gap.normal, a.velocity - b.velocity),
                reach_along(gap.normal, box_a, a), reach_along(gap.normal, box_b, b)};
            return now.time_left(most);
        };
        double left = time_left(open[widest]);
        // Any axis that stays open is as good. It pays to ask the others when it was not far.
        for (std::size_t i = 0; i < count && left < worthwhile * most; ++i)
            if (i != widest) left = std::max(left, time_left(open[i]));
        return left;
    });
}

Advanced advance_to_gap(const PlaneSurface& plane, const SteadyBox& box, const GapSearch& search,
                        std::uint32_t& steps)
{
    const auto height = [&](double time) {
        return glm::dot(plane.normal, box.centre + time * box.velocity) - plane.offset;
    };
    if (std::min(height(search.from), height(search.to)) > box.radius)
        return {search.to, Advanced::End::clear};
    return advance_by(search, steps, [&](double time, double most) {
        const OrientedBox there = box.at(time);
        const double room = gap_between(plane, there).distance - search.gap;
        if (room <= search.near) return 0.0;
        const Forecast now{
            room, -glm::dot(plane.normal, box.velocity), {}, reach_along(plane.normal, there, box)};
        return now.time_left(most);
    });
}

} // namespace hapnet::scene

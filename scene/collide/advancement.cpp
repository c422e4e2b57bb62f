// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/advancement.hpp"

#include "scene/collide/pose.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

// The share of the remaining time that one axis should clear. If it clears less, other axes are
// tried.
constexpr double worthwhile = 0.25;

/// Returns the widest gap that counts, or 0 if only overlaps count.
double widest(const GapSearch& search) { return std::max(0.0, search.gap + search.near); }

/// Limits a search to the time in which the bounding spheres of two bodies are near each other.
/// Returns false if they never are, as for most pairs.
bool narrow_to_spheres(const SteadyBox& a, const SteadyBox& b, GapSearch& search)
{
    const glm::dvec3 velocity = b.velocity - a.velocity;
    const glm::dvec3 offset = b.centre - a.centre + search.from * velocity;
    const double reach = a.radius + b.radius + widest(search);
    const double outside = glm::dot(offset, offset) - reach * reach;
    const double along = -glm::dot(offset, velocity);
    if (outside > 0.0 && along <= 0.0) return false;
    const double square = glm::dot(velocity, velocity);
    const double root = along * along - square * outside;
    if (root < 0.0) return false;
    const double time = search.to - search.from;
    const double half = std::sqrt(root);
    // The margin for rounding: the search begins a little earlier and ends a little later.
    constexpr double more = 1e-9;
    const double enter = outside > 0.0 ? (1.0 - more) * outside / (along + half) : 0.0;
    if (enter >= time) return false;
    search.from += enter;
    const double leave = (1.0 + more) * (along + half);
    if (leave < time * square)
        search.to = std::min(search.to, search.from - enter + leave / square);
    return true;
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

/// Returns the time for which two bodies stay more than `gap` apart along a normal, however far
/// they turn.
double time_beside(const Mover& a, const Mover& b, const glm::dvec3& normal, double gap)
{
    const double room = glm::dot(normal, b.pivot() - a.pivot()) - gap -
                        a.reach_in_all_turns(normal) - b.reach_in_all_turns(normal);
    if (!(room > 0.0)) return 0.0;
    const double approach = glm::dot(normal, a.motion.velocity - b.motion.velocity);
    return approach > 0.0 ? room / approach : HUGE_VAL;
}

/// As time_beside(), along normals that belong to the bodies' axes of rotation and not to their
/// present orientations.
double time_beside_any(const Mover& a, const Mover& b, double gap)
{
    const glm::dvec3 offset = b.pivot() - a.pivot();
    const auto along = [&](const glm::dvec3& axis) {
        const double square = glm::dot(axis, axis);
        if (!(square > 0.0)) return 0.0;
        const double side = glm::dot(axis, offset) < 0.0 ? -1.0 : 1.0;
        return time_beside(a, b, side / std::sqrt(square) * axis, gap);
    };
    return std::max({along(offset), along(a.motion.spin), along(b.motion.spin)});
}

/// Advances two bodies that do not turn; exact.
Advanced advance_straight(const Mover& a, const Mover& b, const GapSearch& search)
{
    const glm::dvec3 offset = b.box.centre - a.box.centre;
    const glm::dvec3 velocity = b.motion.velocity - a.motion.velocity;
    const double gap = search.gap + search.near;
    double enter = 0.0; // seconds after `from`
    double leave = search.to - search.from;
    const auto consider = [&](const glm::dvec3& direction, double length) {
        const double reach =
            half_projection(a.box, direction) + half_projection(b.box, direction) + gap * length;
        const double place = glm::dot(direction, offset);
        const double speed = glm::dot(direction, velocity);
        // |place + t speed| <= reach
        if (std::abs(place) > reach) {
            const double approach = place < 0.0 ? speed : -speed;
            if (!(approach > 0.0)) return false;
            enter = std::max(enter, (std::abs(place) - reach) / approach);
        }
        if (speed != 0.0)
            leave = std::min(leave, (reach + (speed < 0.0 ? place : -place)) / std::abs(speed));
        return enter <= leave;
    };
    const Advanced clear{search.to, Advanced::End::clear};
    for (const int i : {0, 1, 2})
        if (!consider(a.box.axes[i], 1.0)) return clear;
    for (const int j : {0, 1, 2})
        if (!consider(b.box.axes[j], 1.0)) return clear;
    for (const int i : {0, 1, 2}) {
        for (const int j : {0, 1, 2}) {
            const glm::dvec3 direction = glm::cross(a.box.axes[i], b.box.axes[j]);
            const double square = glm::dot(direction, direction);
            if (square >= parallel_sine2 && !consider(direction, std::sqrt(square))) return clear;
        }
    }
    return {search.from + enter, Advanced::End::reached};
}

/// Returns the greatest acceleration of a turning body's corners towards the axis, m/s^2.
double bend_of(const Mover& mover)
{
    return mover.speed_of_turning * mover.speed_of_turning * mover.whirl.widest;
}

/// Adds the extent of one body along a constant normal, and its rate of change: those of the half
/// edges of a box, or of the core of a round body.
std::size_t add_parts(Forecast& forecast, std::size_t count, const Mover& mover,
                      const glm::dvec3& normal)
{
    const glm::dvec3 half = mover.motion.core_half();
    const PerAxis parts = per_axis(half * (normal * mover.box.axes));
    const PerAxis speeds =
        per_axis(half * (glm::cross(normal, mover.motion.spin) * mover.box.axes));
    for (const std::size_t i : {0U, 1U, 2U}) {
        if (half[static_cast<int>(i)] == 0.0) continue;
        forecast.parts[count] = parts[i];
        forecast.speeds[count] = speeds[i];
        ++count;
    }
    return count;
}

/// Advances two bodies of which one is round, along the single normal that separates them. Without
/// rotation that is Newton's method, as their distance is then convex. A core has at most one edge,
/// so that the two bodies have at most four parts.
Advanced advance_round(Mover& a, Mover& b, const GapSearch& search, std::uint32_t& steps)
{
    const bool whirl = a.whirl.is_known || b.whirl.is_known;
    return advance_by(search, steps, [&](double time, double most) {
        a.go_to(time);
        b.go_to(time);
        const Gap gap = gap_between(a.box, b.box);
        const double room = gap.distance - search.gap;
        if (room <= search.near) return 0.0;
        Forecast now{.room = room,
                     .approach = glm::dot(gap.normal, a.velocity() - b.velocity()),
                     .bend = bend_of(a) + bend_of(b)};
        add_parts(now, add_parts(now, 0, a, gap.normal), b, gap.normal);
        double left = now.time_left(most);
        if (whirl && left < most)
            left = std::max({left, time_beside(a, b, gap.normal, search.gap),
                             time_beside_any(a, b, search.gap)});
        return std::min(left, most);
    });
}

} // namespace

OrientedBox SteadyBox::at(double time) const
{
    const glm::dmat3 axes = axes_of(orientation_at(time));
    if (is_part) return {centre + time * velocity + axes * arm, axes * frame, half, rounding};
    return {centre + time * velocity, axes, half, rounding};
}

glm::dquat SteadyBox::orientation_at(double time) const
{
    return spin == glm::dvec3{0.0} ? orientation : rotated(orientation, time * spin);
}

void SteadyBox::put(const glm::dvec3& place, const glm::dquat& turned, double time)
{
    centre = place - time * velocity;
    orientation = spin == glm::dvec3{0.0} ? turned : rotated(turned, -time * spin);
}

Advanced advance_to_gap(const SteadyBox& a, const SteadyBox& b, const GapSearch& asked,
                        std::uint32_t& steps)
{
    const Advanced clear{asked.to, Advanced::End::clear};
    GapSearch search = asked;
    if (!narrow_to_spheres(a, b, search)) return clear;
    if (steps == 0) return {search.from, Advanced::End::unfinished};
    Mover first{a, search.from, search.to};
    Mover second{b, search.from, search.to};
    Advanced advanced;
    if (a.is_round() || b.is_round()) {
        advanced = advance_round(first, second, search, steps);
    } else if (!first.turns && !second.turns) {
        --steps;
        advanced = advance_straight(first, second, search);
    } else {
        const bool whirl = first.whirl.is_known || second.whirl.is_known;
        const double apart = a.radius + b.radius + widest(search) + (length(a.arm) + length(b.arm));
        advanced = advance_by(search, steps, [&](double time, double most) {
            first.go_to(time);
            second.go_to(time);
            const Pose pose{first, second};
            Pose::OpenAxes open;
            pose.find_open(search.gap + search.near, open);
            if (open.count == 0) return 0.0;
            const auto time_left = [&](const Pose::Open& axis) {
                double left = pose.forecast(axis, search.gap, apart).time_left(most);
                if (whirl && left < most)
                    left =
                        std::max(left, time_beside(first, second, pose.normal(axis), search.gap));
                return std::min(left, most);
            };
            double left = time_left(open.axes[open.widest]);
            // Any axis that stays open is as good as the widest. If that clears little time, it
            // pays to try the others.
            for (std::size_t i = 0; i < open.count && left < worthwhile * most; ++i)
                if (i != open.widest) left = std::max(left, time_left(open.axes[i]));
            if (whirl && left < worthwhile * most)
                left = std::max(left, time_beside_any(first, second, search.gap));
            return std::min(left, most);
        });
    }
    return advanced.end == Advanced::End::clear ? clear : advanced;
}

Advanced advance_to_gap(const PlaneSurface& plane, const SteadyBox& box, const GapSearch& search,
                        std::uint32_t& steps)
{
    const auto height = [&](double time) {
        return glm::dot(plane.normal, box.centre + time * box.velocity) - plane.offset;
    };
    if (std::min(height(search.from), height(search.to)) > box.radius + widest(search))
        return {search.to, Advanced::End::clear};
    Mover mover{box, search.from, search.to};
    const double falling = -glm::dot(plane.normal, box.velocity);
    const double bend = bend_of(mover);
    return advance_by(search, steps, [&](double time, double most) {
        mover.go_to(time);
        const double room = gap_between(plane, mover.box).distance - search.gap;
        if (room <= search.near) return 0.0;
        Forecast now{.room = room, .approach = falling, .bend = bend};
        if (box.is_part) now.approach = -glm::dot(plane.normal, mover.velocity());
        add_parts(now, 0, mover, plane.normal);
        double left = now.time_left(most);
        if (mover.turns && left < most) {
            const double beside =
                height(time) - search.gap - mover.reach_in_all_turns(plane.normal);
            if (beside > 0.0) left = falling > 0.0 ? std::max(left, beside / falling) : most;
        }
        return std::min(left, most);
    });
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/round.hpp"

#include "scene/collide/sphere_box.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace hapnet::scene {

namespace {

// Lines up to this sine off a face's edge or another line count as parallel to it.
constexpr double along_sine = 1.0 / 64.0;
// Cores nearer than this share of the rounding have no direction between them.
constexpr double no_distance = 1e-9;

/// The core of a round body: from centre - half * axis to centre + half * axis.
struct CoreLine {
    glm::dvec3 centre{0.0};
    glm::dvec3 axis{1.0, 0.0, 0.0}; // unit
    double half = 0.0;              // 0: the line is a point

    [[nodiscard]] glm::dvec3 at(double place) const { return centre + place * axis; }
};

CoreLine line_of(const OrientedBox& shape)
{
    const glm::dvec3 core = shape.half - shape.rounding;
    const int axis = core.x > 0.0 ? 0 : core.y > 0.0 ? 1 : 2;
    return {shape.centre, shape.axes[axis], core[axis]};
}

/// The place where a line and another core are nearest.
struct Meeting {
    double distance = 0.0;  // between the cores; < 0 if the line is in the box
    glm::dvec3 normal{0.0}; // unit, from the line to the other core
    double place = 0.0;     // place on the line
    glm::dvec3 other{0.0};  // the nearest point of the other core
    // The part of the line along which the other core is as near, or would be if the line did not
    // tilt.
    double from = 0.0, to = 0.0;
    double tilt = 0.0; // how much the line approaches the other core along its length

    void set_alongside(double first, double last)
    {
        from = std::min(first, place);
        to = std::max(last, place);
    }
};

glm::dvec3 any_across(const glm::dvec3& axis)
{
    const glm::dvec3 size = glm::abs(axis);
    const glm::dvec3 across = size.x <= size.y && size.x <= size.z
                                  ? glm::dvec3{0.0, -axis.z, axis.y}
                                  : glm::dvec3{axis.y, -axis.x, 0.0};
    return across / length(across);
}

Meeting meet(const CoreLine& line, const CoreLine& other, double rounding)
{
    Meeting found;
    const glm::dvec3 offset = other.centre - line.centre;
    const double cosine = glm::dot(line.axis, other.axis);
    const double on_line = glm::dot(line.axis, offset);
    const double on_other = -glm::dot(other.axis, offset);
    const double sine2 = 1.0 - cosine * cosine;
    const double reach = std::abs(cosine) * other.half;
    const bool is_along = line.half > 0.0 && other.half > 0.0 && sine2 <= along_sine * along_sine;
    // The part of the line that is beside the other core.
    const double first = std::max(-line.half, on_line - reach);
    const double last = std::min(line.half, on_line + reach);
    constexpr double no_sine2 = 1e-20;
    if (sine2 > no_sine2) {
        found.place = (on_line + cosine * on_other) / sine2;
    } else {
        found.place = 0.5 * (first + last);
    }
    found.place = std::clamp(found.place, -line.half, line.half);
    const auto across = [&](double place) {
        return std::clamp(on_other + cosine * place, -other.half, other.half);
    };
    found.place = std::clamp(on_line + cosine * across(found.place), -line.half, line.half);
    const double there = across(found.place);
    found.other = other.at(there);
    const glm::dvec3 way = found.other - line.at(found.place);
    found.distance = length(way);
    if (found.distance > no_distance * rounding) {
        found.normal = way / found.distance;
    } else {
        const glm::dvec3 out = glm::cross(line.axis, other.axis);
        found.distance = 0.0;
        found.normal = is_along || sine2 <= no_sine2 ? any_across(line.axis) : out / length(out);
        if (glm::dot(found.normal, offset) < 0.0) found.normal = -found.normal;
    }
    found.from = found.to = found.place;
    if (is_along && first < last) {
        found.set_alongside(first, last);
        found.tilt = glm::dot(found.normal, line.axis - cosine * other.axis);
    }
    return found;
}

/// A line and a box, in the box's frame.
class LineAndBox {
public:
    LineAndBox(const CoreLine& line, const OrientedBox& box)
        : line_{line},
          box_{box},
          centre_{to_local(box, line.centre)},
          axis_{glm::dot(box.axes[0], line.axis), glm::dot(box.axes[1], line.axis),
                glm::dot(box.axes[2], line.axis)}
    {}

    /// Finds the meeting. With `tilts`, a line that is very slightly inclined to a face counts as
    /// lying along it.
    [[nodiscard]] Meeting meet(double rounding, bool tilts) const
    {
        Meeting found;
        found.place = nearest();
        const glm::dvec3 place = at(found.place);
        const glm::dvec3 on_box = glm::clamp(place, -box_.half, box_.half);
        glm::dvec3 way = on_box - place;
        found.distance = length(way);
        if (found.distance <= no_distance * rounding) return overlap();
        found.other = box_.centre + box_.axes * on_box;
        // Such a line is nearest at its end, or at an edge that its foot has passed by very little.
        std::array<bool, 3> within{}, nearly{};
        glm::dvec3 across = way;
        for (const int i : {0, 1, 2}) {
            const auto index = static_cast<std::size_t>(i);
            within[index] = nearly[index] = way[i] == 0.0;
            if (!tilts || std::abs(way[i]) > along_sine * found.distance ||
                std::abs(axis_[i]) <= along_sine)
                continue;
            nearly[index] = true;
            across[i] = 0.0;
        }
        found.normal = box_.axes * (across / length(across));
        set_alongside(found, nearly);
        if (nearly == within || found.from < found.to) return found;
        found.normal = box_.axes * (way / found.distance);
        set_alongside(found, within);
        return found;
    }

private:
    [[nodiscard]] glm::dvec3 at(double place) const { return centre_ + place * axis_; }

    /// Returns half of the rate at which the squared distance grows along the line. The rate never
    /// falls.
    [[nodiscard]] double slope(double place) const
    {
        const glm::dvec3 there = at(place);
        return glm::dot(axis_, there - glm::clamp(there, -box_.half, box_.half));
    }

    /// Returns the point on the line with the least distance, or the middle of the points that are
    /// equally near. The slope is linear between two bends, where the line enters or leaves the
    /// slab of an axis.
    [[nodiscard]] double nearest() const
    {
        struct Bend {
            double place, slope;
        };
        constexpr double far = std::numeric_limits<double>::infinity();
        Bend falls{-far, 0.0}, rises{far, 0.0}; // the last before the minimum, the first after it
        double first_level = far, last_level = -far; // first and last place where the slope is 0
        const auto consider = [&](double place) {
            const double its = slope(place);
            if (its < 0.0 && place > falls.place) falls = {place, its};
            if (its > 0.0 && place < rises.place) rises = {place, its};
            if (its == 0.0) {
                first_level = std::min(first_level, place);
                last_level = std::max(last_level, place);
            }
        };
        consider(-line_.half);
        consider(line_.half);
        for (const int i : {0, 1, 2}) {
            if (axis_[i] == 0.0) continue;
            for (const double face : {-box_.half[i], box_.half[i]}) {
                const double bend = (face - centre_[i]) / axis_[i];
                if (std::abs(bend) < line_.half) consider(bend);
            }
        }
        if (first_level <= last_level) return 0.5 * (first_level + last_level);
        if (falls.place == -far) return -line_.half;
        if (rises.place == far) return line_.half;
        const double share = falls.slope / (falls.slope - rises.slope);
        return falls.place + share * (rises.place - falls.place);
    }

    /// Sets the stretch of the line that is within the slabs of those axes of the box along which
    /// the line does not approach a corner or an edge.
    void set_alongside(Meeting& found, const std::array<bool, 3>& within) const
    {
        found.from = found.to = found.place;
        const int count = int{within[0]} + int{within[1]} + int{within[2]};
        if (line_.half == 0.0 || count == 0) return;
        double first = -line_.half, last = line_.half;
        double along2 = 0.0;
        for (const int i : {0, 1, 2}) {
            if (!within[static_cast<std::size_t>(i)]) continue;
            along2 += axis_[i] * axis_[i];
            if (axis_[i] == 0.0) continue;
            const double one = (-box_.half[i] - centre_[i]) / axis_[i];
            const double two = (box_.half[i] - centre_[i]) / axis_[i];
            first = std::max(first, std::min(one, two));
            last = std::min(last, std::max(one, two));
        }
        // Beside an edge only a parallel line counts. On another line, points farther along are
        // farther away.
        if (count == 1 && 1.0 - along2 > along_sine * along_sine) return;
        if (!(first < last)) return;
        found.set_alongside(first, last);
        found.tilt = glm::dot(found.normal, line_.axis);
    }

    /// Returns the shortest way out along the six axes.
    [[nodiscard]] Meeting overlap() const
    {
        Meeting found;
        glm::dvec3 best{0.0};
        std::array<bool, 3> within{};
        double least = std::numeric_limits<double>::infinity();
        const auto consider = [&](const glm::dvec3& normal, int face) {
            const double depth = glm::dot(glm::abs(normal), box_.half) +
                                 line_.half * std::abs(glm::dot(normal, axis_)) -
                                 std::abs(glm::dot(normal, centre_));
            if (!(depth < least)) return;
            least = depth;
            best = glm::dot(normal, centre_) > 0.0 ? -normal : normal; // the direction into the box
            within = {};
            if (face < 3) within = {face != 0, face != 1, face != 2};
        };
        for (const int i : {0, 1, 2}) {
            glm::dvec3 normal{0.0};
            normal[i] = 1.0;
            consider(normal, i);
        }
        for (const int i : {0, 1, 2}) {
            if (line_.half == 0.0) break;
            glm::dvec3 edge{0.0};
            edge[i] = 1.0;
            const glm::dvec3 across = glm::cross(axis_, edge);
            const double size = length(across);
            if (size > along_sine) consider(across / size, 3);
        }
        // The deepest place is an end of the line. If all places are equally deep, it is the middle
        // of the part inside.
        found.distance = -least;
        found.normal = box_.axes * best;
        const double into = glm::dot(best, axis_);
        constexpr double level = 1e-9;
        found.place = std::abs(into) > level ? std::copysign(line_.half, into) : nearest();
        found.other = line_.at(found.place) - least * found.normal;
        set_alongside(found, within);
        return found;
    }

    const CoreLine& line_;
    const OrientedBox& box_;
    glm::dvec3 centre_, axis_;
};

/// Finds where a round shape and another shape are nearest.
Meeting meet(const OrientedBox& round, const OrientedBox& other, bool tilts = false)
{
    const CoreLine line = line_of(round);
    const double rounding = round.rounding + other.rounding;
    if (other.is_round()) return meet(line, line_of(other), rounding);
    return LineAndBox{line, other}.meet(rounding, tilts);
}

} // namespace

Gap round_gap(const OrientedBox& a, const OrientedBox& b)
{
    const Meeting found = a.is_round() ? meet(a, b) : meet(b, a);
    return {found.distance - (a.rounding + b.rounding),
            a.is_round() ? found.normal : -found.normal};
}

Separation round_separation(const OrientedBox& first, const OrientedBox& second)
{
    const bool is_first = first.is_round();
    const OrientedBox& round = is_first ? first : second;
    const OrientedBox& other = is_first ? second : first;
    const Meeting found = meet(round, other);
    const glm::dvec3 on_round = line_of(round).at(found.place) + round.rounding * found.normal;
    const glm::dvec3 on_other = found.other - other.rounding * found.normal;
    return {.distance = found.distance - (round.rounding + other.rounding),
            .direction = is_first ? -found.normal : found.normal,
            .on_first = is_first ? on_round : on_other,
            .on_second = is_first ? on_other : on_round};
}

Separation round_separation(const glm::dvec3& point, const OrientedBox& shape)
{
    return round_separation(OrientedBox{point, glm::dmat3{1.0}, glm::dvec3{0.0}, 0.0}, shape);
}

Manifold round_manifold(const OrientedBox& a, const OrientedBox& b, double margin)
{
    const bool is_a = a.is_round();
    const OrientedBox& round = is_a ? a : b;
    const OrientedBox& other = is_a ? b : a;
    const Meeting found = meet(round, other, true);
    const CoreLine line = line_of(round);
    const double separation = found.distance - (round.rounding + other.rounding);
    Manifold manifold;
    manifold.normal = is_a ? found.normal : -found.normal;
    const auto add = [&](double place, std::uint32_t feature) {
        const double here = separation - (place - found.place) * found.tilt;
        if (here > margin) return;
        manifold.points[manifold.count++] = {
            .position = line.at(place) + (round.rounding + 0.5 * here) * found.normal,
            .separation = here,
            .feature = feature};
    };
    constexpr double too_near = 1e-9; // share of the line's half length
    if (found.to - found.from > too_near * line.half) {
        add(found.from, 2);
        add(found.to, 3);
    } else {
        add(found.place, 1);
    }
    return manifold;
}

std::optional<TimeOfImpact> round_time_of_impact(const OrientedBox& a, const OrientedBox& b,
                                                 const glm::dvec3& relative_velocity,
                                                 double time_max)
{
    OrientedBox there = b;
    const double touching = no_distance * (a.rounding + b.rounding);
    TimeOfImpact impact;
    constexpr int steps_max = 32;
    for (int i = 0; i < steps_max; ++i) {
        there.centre = b.centre + impact.time * relative_velocity;
        const Gap gap = round_gap(a, there);
        if (i == 0 && gap.distance < -touching) return std::nullopt;
        const double approach = -glm::dot(gap.normal, relative_velocity);
        if (!(approach > 0.0)) return std::nullopt;
        impact.normal = gap.normal;
        if (gap.distance <= touching) return impact;
        impact.time += gap.distance / approach;
        if (impact.time > time_max) return std::nullopt;
    }
    return impact;
}

std::optional<RayEntry> enter_round(const OrientedBox& shape, const glm::dvec3& origin,
                                    const glm::dvec3& direction, double length)
{
    if (round_separation(origin, shape).distance < 0.0) return RayEntry{0.0, -direction};
    const OrientedBox start{origin, glm::dmat3{1.0}, glm::dvec3{0.0}, 0.0};
    const auto impact = round_time_of_impact(shape, start, direction, length);
    if (!impact) return std::nullopt;
    return RayEntry{impact->time, impact->normal};
}

} // namespace hapnet::scene

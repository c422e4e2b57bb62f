// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/fat_aabbs.hpp"

#include "scene/maths/vector.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace hapnet::scene {

namespace {

// The time for which a body that keeps its velocity stays in its box. A longer time means fewer new
// boxes and more pairs.
constexpr double look_ahead_ticks = 32.0;
// The distance by which a body strays from its path, or its corners by rotation, in mean half
// edges.
constexpr double wander_share = 0.1;
// The greatest size of a stretched box: its length in mean edges of the body, and its volume in
// cubes of that edge. So a box may be long along one axis, but is shorter along several, where it
// would meet many others.
constexpr double stretch_max = 9.0;
constexpr double shorter = 0.75;
// The least number of ticks for which a box lasts, even if it then exceeds that limit.
constexpr double stretch_ticks_min = 2.0;
// The rotation within one tick from which a body counts as spinning.
constexpr double turn_share = 0.25;

bool is_fixed(const BodyProperties& properties)
{
    return properties.mass == 0.0 && !properties.is_kinematic;
}

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// Returns the factor by which a path of this many edges makes a box grow.
double stretch(const glm::dvec3& edges)
{
    return (1.0 + edges.x) * (1.0 + edges.y) * (1.0 + edges.z);
}

/// Returns half the edges of the axis-aligned box around a rotated one.
glm::dvec3 extent(const glm::dquat& q, const glm::dvec3& half)
{
    const glm::dmat3 axes = glm::mat3_cast(q);
    return glm::abs(axes[0]) * half.x + glm::abs(axes[1]) * half.y + glm::abs(axes[2]) * half.z;
}

} // namespace

FatAabbs::FatAabbs(const WorldConfig& config, const Bodies& bodies)
    : tick_{config.tick}, gravity_{config.gravity}, bounds_(bodies.size())
{
    for (std::vector<double>& lane : lanes_) lane.resize(bodies.size());
}

FatAabbs::Size FatAabbs::size_of(const BodyProperties& properties) const
{
    const glm::dvec3& half = properties.half;
    return {.nearby = pair_margin * std::min({half.x, half.y, half.z}),
            .stray = is_fixed(properties) ? 0.0 : wander_share * (half.x + half.y + half.z) / 3.0,
            .radius = std::sqrt(glm::dot(half, half)),
            .ease =
                properties.turning == Turning::locked ? 0.0 : largest(properties.inverse_inertia)};
}

/// Returns a box around the path of the centre within the look-ahead, whose length is limited.
Aabb FatAabbs::path(const Bodies& bodies, Slot slot, double stray) const
{
    const glm::dvec3 position = bodies.position.at(slot);
    const BodyProperties& properties = bodies.properties[slot];
    const double ahead = look_ahead_ticks * tick_;
    const glm::dvec3 way = bodies.velocity.at(slot) * ahead;
    const double length = largest(glm::abs(way));
    if (!(length > stray) || is_fixed(properties)) return {position, position};
    const double edge = 2.0 * (properties.half.x + properties.half.y + properties.half.z) / 3.0;
    const glm::dvec3 edges = glm::abs(way) / edge;
    constexpr double share_min = stretch_ticks_min / look_ahead_ticks;
    double share = std::min(1.0, (stretch_max - 1.0) * edge / length);
    while (share > share_min && stretch(share * edges) > stretch_max) share *= shorter;
    share = std::max(share, share_min);
    const double time = share * ahead;
    const glm::dvec3 drop = gravity_ * (0.5 * time * time);
    const glm::dvec3 straight = share * way;
    glm::dvec3 end = straight;
    for (int axis = 0; axis < 3; ++axis)
        if (properties.inverse_mass[axis] != 0.0) end[axis] += drop[axis];
    const Aabb around = hull(straight, end);
    return {position + glm::min(around.low, 0.0), position + glm::max(around.high, 0.0)};
}

Aabb FatAabbs::renew(const Bodies& bodies, Slot slot)
{
    const BodyProperties& properties = bodies.properties[slot];
    const Size size = size_of(properties);
    const glm::dvec3 momentum = bodies.angular_momentum.at(slot);
    const double turn = std::sqrt(glm::dot(momentum, momentum)) * size.ease * size.radius; // m/s
    const bool spins = turn * tick_ * look_ahead_ticks > size.stray;

    Bounds& bounds = bounds_[properties.id];
    const glm::dvec3 step = glm::abs(bodies.velocity.at(slot)) * tick_;
    const Aabb region = grown(path(bodies, slot, size.stray), glm::dvec3{size.stray} + step);
    bounds.centre = region.centre();
    bounds.room = 0.5 * region.size();
    bounds.orientation = bodies.orientation.at(slot);
    bounds.similarity_min = -1.0;
    bounds.angular_momentum2 = std::numeric_limits<double>::infinity();
    glm::dvec3 margin = glm::dvec3{size.nearby} + glm::abs(gravity_) * (tick_ * tick_);
    if (is_fixed(properties) || size.ease == 0.0) {
        margin += extent(bounds.orientation, properties.half);
    } else if (spins) {
        margin += size.radius;
    } else {
        // A turn by an angle t moves a corner by 2 sin(t/2) r, and cos(t/2) is the scalar product
        // of the two orientations.
        const double sine = size.stray / (2.0 * size.radius);
        bounds.similarity_min = 1.0 - sine * sine;
        const double fastest = turn_share * size.stray / (tick_ * size.radius * size.ease);
        bounds.angular_momentum2 = fastest * fastest;
        margin += extent(bounds.orientation, properties.half) + (1.0 + turn_share) * size.stray;
    }
    if (slot < bodies.awake) update_slot(bodies, slot);
    return grown(region, margin);
}

/// For a body of several parts that spins, each part has the body's whole box. For another one,
/// each part keeps its present distances from the sides of the whole box.
Aabb FatAabbs::around(const Bodies& bodies, PartId part, const Aabb& whole) const
{
    const Slot slot = bodies.slot_of[part];
    const BodyProperties& properties = bodies.properties[slot];
    const Bounds& bounds = bounds_[properties.id];
    const bool spins = bounds.similarity_min < 0.0 && properties.turning != Turning::locked &&
                       !is_fixed(properties);
    if (!properties.has_parts() || spins) return whole;
    const BodyPart& its = bodies.parts[part];
    const glm::dmat3 axes = glm::mat3_cast(bounds.orientation);
    const glm::dvec3 at = axes * its.at;
    const glm::dmat3 own = axes * its.axes;
    const glm::dvec3 out = glm::abs(own[0]) * its.half.x + glm::abs(own[1]) * its.half.y +
                           glm::abs(own[2]) * its.half.z;
    const glm::dvec3 all = extent(bounds.orientation, properties.half);
    return {whole.low + (all + at - out), whole.high - (all - at - out)};
}

void FatAabbs::update_slot(const Bodies& bodies, Slot slot)
{
    const Bounds& bounds = bounds_[bodies.properties[slot].id];
    const glm::dvec3& centre = bounds.centre;
    const glm::dvec3& room = bounds.room;
    const glm::dquat& q = bounds.orientation;
    const std::array<double, lanes> values{centre.x,
                                           centre.y,
                                           centre.z,
                                           room.x,
                                           room.y,
                                           room.z,
                                           q.w,
                                           q.x,
                                           q.y,
                                           q.z,
                                           bounds.similarity_min,
                                           bounds.angular_momentum2};
    for (std::size_t lane = 0; lane < lanes; ++lane) lanes_[lane][slot] = values[lane];
}

namespace {

/// The lanes that the check of the bodies reads.
struct Lanes {
    const double *x, *y, *z;
    const double *vx, *vy, *vz;
    const double *lx, *ly, *lz;
    const double *w, *i, *j, *k;
    std::array<const double*, 12> bounds;
    double tick;
};

/// Returns the room that is left along an axis at the end of a step; < 0: the body has left its
/// box.
inline double rest_of(double room, double away, double velocity, double tick)
{
    return room - std::abs(away) - std::abs(velocity) * tick;
}

/// Returns bits whose highest one is set if the body has left its box: the signs of the remaining
/// room at each limit, combined with `or`. Without comparisons GCC 12 and Clang 14 check two bodies
/// (or four) at once.
inline std::uint64_t left_at(const Lanes& l, std::size_t n)
{
    const double x = rest_of(l.bounds[3][n], l.x[n] - l.bounds[0][n], l.vx[n], l.tick);
    const double y = rest_of(l.bounds[4][n], l.y[n] - l.bounds[1][n], l.vy[n], l.tick);
    const double z = rest_of(l.bounds[5][n], l.z[n] - l.bounds[2][n], l.vz[n], l.tick);
    const double likeness = l.w[n] * l.bounds[6][n] + l.i[n] * l.bounds[7][n] +
                            l.j[n] * l.bounds[8][n] + l.k[n] * l.bounds[9][n];
    const double turn = likeness * likeness - l.bounds[10][n];
    const double momentum2 = l.lx[n] * l.lx[n] + l.ly[n] * l.ly[n] + l.lz[n] * l.lz[n];
    const double spin = l.bounds[11][n] - momentum2;
    return std::bit_cast<std::uint64_t>(x) | std::bit_cast<std::uint64_t>(y) |
           std::bit_cast<std::uint64_t>(z) | std::bit_cast<std::uint64_t>(turn) |
           std::bit_cast<std::uint64_t>(spin);
}

constexpr unsigned sign = 63;
constexpr std::size_t block = 16;

/// True if any body of a block has left its box.
bool any_left(const Lanes& lanes, std::size_t first)
{
    const Lanes own = lanes; // a local copy, which nothing else can change
    std::uint64_t any = 0;
    for (std::size_t n = first; n < first + block; ++n) any |= left_at(own, n);
    return any >> sign != 0;
}

} // namespace

/// Checks a few bodies, one after the other, without the lanes' addresses.
bool FatAabbs::has_moved_out(const Bodies& bodies, Slot slot) const
{
    const Bounds& bounds = bounds_[bodies.properties[slot].id];
    const glm::dvec3 away =
        sizes(bodies.position.at(slot) - bounds.centre) + tick_ * sizes(bodies.velocity.at(slot));
    const glm::dvec3 momentum = bodies.angular_momentum.at(slot);
    const glm::dquat now = bodies.orientation.at(slot);
    const glm::dquat& then = bounds.orientation;
    const double likeness = now.w * then.w + now.x * then.x + now.y * then.y + now.z * then.z;
    return away.x > bounds.room.x || away.y > bounds.room.y || away.z > bounds.room.z ||
           likeness * likeness < bounds.similarity_min ||
           glm::dot(momentum, momentum) > bounds.angular_momentum2;
}

void FatAabbs::find_moved_out(const Bodies& bodies, Bounded<Slot>& moved_out) const
{
    constexpr Slot few = 3;
    if (bodies.awake <= few) {
        for (Slot slot = 0; slot < bodies.awake; ++slot)
            if (has_moved_out(bodies, slot)) moved_out.add(slot);
        return;
    }
    const Bodies::Lanes3& p = bodies.position;
    const Bodies::Lanes3& v = bodies.velocity;
    const Bodies::Lanes3& l = bodies.angular_momentum;
    const Bodies::Lanes4& q = bodies.orientation;
    Lanes all{p.x.data(), p.y.data(), p.z.data(), v.x.data(), v.y.data(),
              v.z.data(), l.x.data(), l.y.data(), l.z.data(), q.w.data(),
              q.x.data(), q.y.data(), q.z.data(), {},         tick_};
    for (std::size_t lane = 0; lane < lanes; ++lane) all.bounds[lane] = lanes_[lane].data();

    const std::size_t end = bodies.awake;
    for (std::size_t first = 0; first < end; first += block) {
        const std::size_t last = std::min(first + block, end);
        if (last - first == block && !any_left(all, first)) continue;
        for (std::size_t n = first; n < last; ++n)
            if (left_at(all, n) >> sign != 0) moved_out.add(static_cast<Slot>(n));
    }
}

} // namespace hapnet::scene

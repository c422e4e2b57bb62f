// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/sleep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hapnet::scene {

namespace {

constexpr double rest_s = 0.1;
// The number of searches for islands during the time of rest, while a body could sleep but its
// neighbours are not at rest.
constexpr double looks_per_rest = 4.0;
constexpr double gravity_share = 0.1;
constexpr double size_share = 1e-3;

double rest_speed(const WorldConfig& config, const BodyProperties& properties)
{
    const double gravity = std::sqrt(glm::dot(config.gravity, config.gravity));
    const double size = 2.0 * std::min({properties.half.x, properties.half.y, properties.half.z});
    return gravity_share * gravity * config.tick + size_share * std::sqrt(gravity * size);
}

/// Returns the angular momentum at which no corner is faster than a speed.
double rest_momentum(const BodyProperties& properties, double speed)
{
    const glm::dvec3& easy = properties.inverse_inertia;
    const double ease = std::max({easy.x, easy.y, easy.z});
    if (ease == 0.0) return std::numeric_limits<double>::infinity();
    return speed / (ease * std::sqrt(glm::dot(properties.half, properties.half)));
}

} // namespace

Sleep::Sleep(const WorldConfig& config, const Bodies& bodies)
    : sleeping_{config.sleeping},
      rest_ticks_{std::max(1.0, std::ceil(rest_s / config.tick))},
      interval_{static_cast<std::uint64_t>(std::max(1.0, rest_ticks_ / looks_per_rest))},
      speed2_(bodies.movable),
      momentum2_(bodies.movable),
      rested_(bodies.movable, 0.0),
      motion_(bodies.movable, 0.0),
      islands_{bodies.size()},
      island_rested_(bodies.size(), 0.0),
      queue_{bodies.movable}
{
    for (Slot slot = 0; slot < bodies.movable; ++slot) {
        const double speed = rest_speed(config, bodies.properties[slot]);
        const double momentum = rest_momentum(bodies.properties[slot], speed);
        speed2_[slot] = speed * speed;
        momentum2_[slot] = momentum * momentum;
    }
}

template <BroadPhase broad_phase>
void Sleep::wake(PartId body, Bodies& bodies, PairFinder<broad_phase>& pair_finder)
{
    wake_island(bodies.body_of(body), bodies, pair_finder);
    pair_finder.apply_changes();
}

/// Wakes every sleeping body of the body's island, from neighbour to neighbour.
template <BroadPhase broad_phase>
void Sleep::wake_island(BodyId body, Bodies& bodies, PairFinder<broad_phase>& pair_finder)
{
    if (bodies.slot_of[body] >= bodies.movable) return;
    if (bodies.slot_of[body] >= bodies.awake) move_to_awake(body, bodies, pair_finder);
    keep_awake(bodies, body);
    if (bodies.awake == bodies.movable) return;
    queue_.clear();
    queue_.add(body);
    const PairSet& pairs = pair_finder.all_pairs();
    const auto wake_other = [&](PairIndex index, PartId part) {
        const Slot slot = bodies.slot_of[part];
        if (slot < bodies.awake || slot >= bodies.movable || !touches(pairs[index].memory)) return;
        const BodyId other = bodies.properties[slot].id;
        move_to_awake(other, bodies, pair_finder);
        queue_.add(other);
    };
    while (!queue_.is_empty()) {
        const BodyId next = queue_.take_last();
        bodies.for_parts(next, [&](PartId part) {
            pairs.for_first(part, [&](PairIndex i) { wake_other(i, pairs[i].b); });
            pairs.for_second(part, [&](PairIndex i) { wake_other(i, pairs[i].a); });
        });
    }
}

template <BroadPhase broad_phase>
void Sleep::move_to_awake(BodyId body, Bodies& bodies, PairFinder<broad_phase>& pair_finder)
{
    const Slot from = bodies.slot_of[body];
    const Slot to = bodies.wake(from);
    swap(from, to);
    rested_[to] = 0.0;
    pair_finder.on_wake(bodies, body);
}

template <BroadPhase broad_phase>
void Sleep::fall_asleep(BodyId body, Bodies& bodies, PairFinder<broad_phase>& pair_finder)
{
    const Slot from = bodies.slot_of[body];
    bodies.velocity.put(from, glm::dvec3{0.0});
    bodies.angular_momentum.put(from, glm::dvec3{0.0});
    swap(from, bodies.put_to_sleep(from));
    pair_finder.on_sleep(bodies, body, from);
}

BodyId Sleep::sleeper_disturbed_by(const Bodies& bodies, const Pair& pair) const
{
    const Slot a = bodies.slot_of[pair.a];
    const Slot b = bodies.slot_of[pair.b];
    const Slot mover = std::min(a, b); // awake bodies come first, fixed ones last
    const Slot sleeper = std::max(a, b);
    if (sleeper < bodies.awake || sleeper >= bodies.movable || mover >= bodies.awake)
        return no_body;
    if (rested_[mover] > 0.0) return no_body;
    return bodies.properties[sleeper].id;
}

template <BroadPhase broad_phase>
void Sleep::update(Bodies& bodies, PairFinder<broad_phase>& pair_finder, std::uint64_t ticks)
{
    if (!sleeping_) return;
    if (!count_rest(bodies) || ticks % interval_ != 0) return;
    find_islands(bodies, pair_finder);
    queue_.clear();
    for (Slot slot = 0; slot < bodies.awake; ++slot) {
        const BodyId id = bodies.properties[slot].id;
        if (island_rested_[islands_.root_of(id)] >= rest_ticks_) queue_.add(id);
    }
    // Bodies fall asleep in the order of their ids, so that the order of the slots depends less on
    // earlier ticks.
    std::sort(queue_.begin(), queue_.end());
    for (const BodyId id : queue_) fall_asleep(id, bodies, pair_finder);
    pair_finder.apply_changes();
}

bool Sleep::count_rest(const Bodies& bodies)
{
    const Bodies::Lanes3& v = bodies.velocity;
    const Bodies::Lanes3& l = bodies.angular_momentum;
    double any = 0.0;
    for (Slot i = 0; i < bodies.awake; ++i) { // without branches: many at once
        const double speed2 = v.x[i] * v.x[i] + v.y[i] * v.y[i] + v.z[i] * v.z[i];
        const double momentum2 = l.x[i] * l.x[i] + l.y[i] * l.y[i] + l.z[i] * l.z[i];
        const double stays = speed2 <= speed2_[i] ? 1.0 : 0.0;
        const double lies = momentum2 <= momentum2_[i] ? 1.0 : 0.0;
        const double rested = (rested_[i] + 1.0) * (stays * lies);
        rested_[i] = rested;
        any += rested == 1.0 || rested >= rest_ticks_ ? 1.0 : 0.0;
    }
    if (any == 0.0) return false;
    bool may_sleep = false;
    for (Slot i = 0; i < bodies.awake; ++i) {
        if (rested_[i] == 1.0) motion_[i] = motion_of(bodies, i);
        if (rested_[i] < rest_ticks_) continue;
        constexpr double still = 1e-12; // share of what counts as rest
        if (motion_of(bodies, i) > std::max(motion_[i], still))
            rested_[i] = 0.0;
        else
            may_sleep = true;
    }
    return may_sleep;
}

/// Returns the squared motion and rotation of a body, in shares of the limits of rest.
double Sleep::motion_of(const Bodies& bodies, Slot slot) const
{
    const glm::dvec3 v = bodies.velocity.at(slot), l = bodies.angular_momentum.at(slot);
    constexpr double least = 1e-300;
    return glm::dot(v, v) / std::max(speed2_[slot], least) +
           (std::isinf(momentum2_[slot]) ? 0.0
                                         : glm::dot(l, l) / std::max(momentum2_[slot], least));
}

template <BroadPhase broad_phase>
void Sleep::find_islands(const Bodies& bodies, PairFinder<broad_phase>& pair_finder)
{
    for (Slot slot = 0; slot < bodies.awake; ++slot) islands_.reset(bodies.properties[slot].id);
    for (const PairIndex index : pair_finder.pairs()) {
        const Pair& pair = pair_finder.pair(index);
        const bool are_awake =
            bodies.slot_of[pair.a] < bodies.awake && bodies.slot_of[pair.b] < bodies.awake;
        if (are_awake && touches(pair.memory))
            islands_.join(bodies.body_of(pair.a), bodies.body_of(pair.b));
    }
    for (Slot slot = 0; slot < bodies.awake; ++slot)
        island_rested_[bodies.properties[slot].id] = std::numeric_limits<double>::infinity();
    for (Slot slot = 0; slot < bodies.awake; ++slot) {
        double& least = island_rested_[islands_.root_of(bodies.properties[slot].id)];
        least = std::min(least, rested_[slot]);
    }
}

void Sleep::swap(Slot a, Slot b)
{
    std::swap(speed2_[a], speed2_[b]);
    std::swap(momentum2_[a], momentum2_[b]);
    std::swap(rested_[a], rested_[b]);
    std::swap(motion_[a], motion_[b]);
}

template void Sleep::wake(PartId, Bodies&, PairFinder<BroadPhase::all_pairs>&);
template void Sleep::wake(PartId, Bodies&, PairFinder<BroadPhase::grid>&);
template void Sleep::wake_island(BodyId, Bodies&, PairFinder<BroadPhase::all_pairs>&);
template void Sleep::wake_island(BodyId, Bodies&, PairFinder<BroadPhase::grid>&);
template void Sleep::update(Bodies&, PairFinder<BroadPhase::all_pairs>&, std::uint64_t);
template void Sleep::update(Bodies&, PairFinder<BroadPhase::grid>&, std::uint64_t);

} // namespace hapnet::scene

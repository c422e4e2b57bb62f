// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene_copy.hpp"

#include "proto/base/ensure.hpp"
#include "scene/maths/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

namespace hapnet::peer {

namespace {

// The limits of positions and velocities in the others' messages. A position is limited to this
// many times the distance of the scene's farthest body from the origin. The velocity limit follows
// from the least time in which all of that can be crossed.
constexpr double reach_of_scene = 8.0;
constexpr double reach_least_m = 1.0;
constexpr double crossing_s = 0.1;
constexpr double turn_max_rad_per_s = 1000.0;

double remote_reach_m(const scene::Description& scene)
{
    double farthest_m = 0.0;
    for (const scene::BodyDescription& body : scene.bodies) {
        for (const int axis : {0, 1, 2}) {
            farthest_m =
                std::max(farthest_m, std::abs(body.position.value[axis]) + body.half[axis]);
        }
    }
    return std::clamp(reach_of_scene * farthest_m, reach_least_m, SceneCopy::reach_max_m);
}

std::vector<SharedBody> shared_bodies_of(const Settings& settings)
{
    auto bodies = shared_bodies(settings.scene);
    base::ensure(bodies.has_value() && check_bodies_of(settings.algorithm, *bodies).has_value());
    return *std::move(bodies);
}

std::optional<SharedPoses> poses_of(const Settings& settings, const std::vector<SharedBody>& shared)
{
    if (is_one_without_turning(shared)) return std::nullopt;
    const auto* const base = std::get_if<BaseAlgorithm>(&settings.algorithm);
    const AtRest::Times times = base == nullptr ? AtRest::usual()
                                                : AtRest::Times{base->options().settle_after,
                                                                base->options().settle_within};
    return SharedPoses{shared, settings.introduction.id, times};
}

scene::World world_of(const Settings& settings)
{
    auto world = scene::World::freeze(settings.scene, {.tick = settings.tick});
    base::ensure(world.has_value());
    return *std::move(world);
}

std::optional<FingerFriction> friction_of(const Settings& settings)
{
    if (settings.scene.hands.friction == 0.0) return std::nullopt;
    return FingerFriction{settings.scene.hands};
}

} // namespace

SceneCopy::SceneCopy(const Settings& settings)
    : shared_{shared_bodies_of(settings)},
      body_{shared_.front().id},
      poses_{poses_of(settings, shared_)},
      world_{world_of(settings)},
      friction_{friction_of(settings)},
      tick_{settings.tick},
      wall_{hardest_wall(settings.scene)},
      stiffness_max_n_per_m_{settings.stiffness_max_n_per_m},
      grip_damping_ns_per_m_{settings.grip_damping_ns_per_m},
      share_{rendered_share({})},
      force_max_n_{std::min(settings.scene.hands.force_max_n, scene::force_max_n)},
      remote_reach_m_{remote_reach_m(settings.scene)},
      remote_speed_m_per_s_{remote_reach_m_ / crossing_s},
      effects_(shared_.size())
{}

/// Returns the share of the force on the hand that may be rendered.
double SceneCopy::rendered_share(base::Duration late) const
{
    const double tick_s = base::to_seconds(tick_ + 2 * late); // a force held for T is T / 2 late
    return std::min(share_within(stiffness_max_n_per_m_, wall_),
                    passive_share(wall_, tick_s, grip_damping_ns_per_m_));
}

inline bool SceneCopy::is_shared(const wire::BodyState& body) const
{
    if (!poses_) return body.body == body_ && !body.turning;
    return std::ranges::any_of(shared_, [&](const SharedBody& shared) {
        return shared.id == body.body && shared.turns() == body.turning.has_value();
    });
}

bool SceneCopy::is_plausible(const wire::State& state) const
{
    const auto is_possible = [&](const base::Position& place, const base::Velocity& velocity) {
        return scene::is_within(place.value, remote_reach_m_) &&
               scene::is_within(velocity.value, remote_speed_m_per_s_);
    };
    if (!is_possible(state.hip, state.hip_velocity)) return false;
    for (const wire::BodyState& body : state.bodies) {
        if (!is_shared(body) || !is_possible(body.position, body.velocity)) return false;
        if (body.turning && !scene::is_within(body.turning->angular_velocity, turn_max_rad_per_s))
            return false;
    }
    return true;
}

void SceneCopy::take_over(std::span<const Remote> others)
{
    for (const Remote& other : others) {
        if (other.bodies_known() < shared_.size()) continue;
        if (poses_) {
            poses_->take_over(world_, other);
        } else {
            const wire::BodyState& body = *other.body();
            world_.place(body_, body.position, body.velocity);
        }
        is_known_ = true;
        return;
    }
}

void SceneCopy::tick(Tick& tick, Algorithm& algorithm, const Situation& situation,
                     const scene::HandInput& hand)
{
    note_places();
    if (is_known_) move(tick, algorithm, situation, hand);
    account(tick, situation.now);
}

inline void SceneCopy::note_places()
{
    for (std::size_t i = 0; i < shared_.size(); ++i) {
        effects_[i].place_before = world_.position(shared_[i].id);
        if (shared_[i].turns())
            effects_[i].orientation_before = world_.body(shared_[i].id).orientation;
    }
}

void SceneCopy::move(Tick& tick, Algorithm& algorithm, const Situation& situation,
                     const scene::HandInput& hand)
{
    world_.set_hand(own_hand, hand);
    base::Force rubbing;
    if (friction_) {
        rubbing = friction_->on_body(hand, world_.body(body_));
        world_.push(body_, rubbing);
    }
    const Outcome outcome =
        std::visit([&](auto& one) { return one.tick(world_, situation); }, algorithm);
    tick.touched = outcome.touched;
    tick.remote_touching = outcome.remote_touching;
    tick.remote_force = outcome.remote_force;
    tick.remote_hip = outcome.remote_hip;
    base::Force on_hand = outcome.on_hand;
    if (friction_) {
        friction_->on_touch(tick.touched);
        tick.touched.on_body += rubbing;
        tick.touched.on_hand += -rubbing;
        on_hand += -rubbing;
    }
    const bool is_late = outcome.late > base::Duration{0};
    tick.force = (is_late ? rendered_share(outcome.late) : share_) * on_hand;
}

/// Keeps a body within reach and returns its place. Otherwise a remote with false data could drag
/// it so far that the other copy rejects its place, and the two copies would never agree again.
inline base::Position SceneCopy::keep_within_reach(scene::BodyId body)
{
    const base::Position place = world_.position(body);
    if (scene::is_within(place.value, remote_reach_m_)) return place;
    constexpr double inside = 0.99; // leaves room for rounding on the wire
    const base::Position back{
        glm::clamp(place.value, -inside * remote_reach_m_, inside * remote_reach_m_)};
    world_.place(body, back, {});
    return world_.position(body);
}

void SceneCopy::account(const Tick& tick, base::TimePoint now)
{
    using Mover = SharedPoses::Mover;
    if (poses_) {
        for (std::size_t i = 0; i < shared_.size(); ++i)
            account_for(i, poses_->mover(i), tick, now);
        return;
    }
    const Mover of_others = tick.remote_touching ? Mover::others : Mover::none;
    account_for(0, tick.touched.touching ? Mover::own : of_others, tick, now);
}

inline void SceneCopy::account_for(std::size_t body, SharedPoses::Mover mover, const Tick& tick,
                                   base::TimePoint now)
{
    Effect& effect = effects_[body];
    const SharedBody& shared = shared_[body];
    if (mover == SharedPoses::Mover::own) {
        effect.last_touch = now;
        if (tick.touched.body == shared.id) add_push(body, tick.touched);
    } else if (mover == SharedPoses::Mover::others) {
        effect.last_touch.reset(); // another hand has taken the body over
    }
    // After a push, the body still coasts from this hand for a while.
    const bool ours = effect.last_touch && now - *effect.last_touch < push_lasts;
    const base::Displacement moved = keep_within_reach(shared.id) - effect.place_before;
    if (ours) effect.sums.add(moved);
    bool stirs = mover == SharedPoses::Mover::own || base::norm(moved) > 1e-9;
    if (shared.turns()) {
        const glm::dvec3 turned =
            scene::turn_between(effect.orientation_before, world_.body(shared.id).orientation);
        if (ours) effect.sums.add_rotation(turned);
        stirs = stirs || base::norm(base::Displacement{turned}) > 1e-7;
    }
    if (stirs) effect.last_stir = now;
}

/// Adds the push of this hand on a body in the tick.
void SceneCopy::add_push(std::size_t body, const scene::HandTouch& touch)
{
    Effect& effect = effects_[body];
    const base::Impulse given = touch.on_body * tick_;
    effect.sums.add(given);
    if (!shared_[body].turns()) return;
    const base::Displacement lever = world_.state().hands[own_hand].position - effect.place_before;
    effect.sums.add_angular(glm::cross(lever.value, given.value));
}

inline wire::BodyState SceneCopy::body_state(std::size_t body) const
{
    const SharedBody& shared = shared_[body];
    const EffectSums& sums = effects_[body].sums;
    wire::BodyState state{.body = static_cast<std::uint16_t>(shared.id),
                          .position = world_.position(shared.id),
                          .velocity = world_.velocity(shared.id),
                          .caused_displacement_um = sums.displacement_um(),
                          .caused_impulse_uns = sums.impulse_uns(),
                          .turning = {}};
    if (!shared.turns()) return state;
    const scene::BodyState turned = world_.body(shared.id);
    const auto spin =
        base::limited(base::Velocity{turned.angular_velocity}, 0.99 * turn_max_rad_per_s);
    state.turning = {.orientation = wire::Orientation::from(turned.orientation),
                     .angular_velocity = spin.value,
                     .caused_rotation_urad = sums.rotation_urad(),
                     .caused_angular_impulse_unms = sums.angular_impulse_unms()};
    return state;
}

void SceneCopy::say(wire::State& state, BodySet bodies) const
{
    state.bodies.clear();
    for (std::size_t i = 0; i < shared_.size(); ++i)
        if ((bodies >> i & 1U) != 0) state.bodies.add([&] { return body_state(i); });
}

} // namespace hapnet::peer

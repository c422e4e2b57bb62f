// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/couple.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::peer {

namespace {

double drag_of(const scene::World& world, scene::BodyId body)
{
    const scene::Bodies& bodies = world.state().bodies;
    return bodies.properties[bodies.slot_of[body]].drag;
}

} // namespace

double Couple::Spring::stored_j() const
{
    return 0.5 * stiffness_n_per_m * glm::dot(stretch, stretch);
}

void Couple::prepare(std::size_t others)
{
    springs_.assign(others, Spring{});
    for (Spring& spring : springs_) spring.tank_j = options_.tank_j;
}

void Couple::hear(const ReceivedState& received)
{
    if (!received.taken) return;
    const base::Duration delay =
        std::max(base::Duration{0}, one_way_delay(received).value_or(base::Duration{0}));
    Spring& spring = springs_[received.from];
    spring.sent_at = received.arrived - delay;
    spring.ages.add(base::to_seconds(delay));
}

/// Stretches a spring to the place where its owner has the body, as far as the tank allows. If
/// `owner` is nullptr, the spring is released.
void Couple::draw(Spring& spring, const Remote* owner, const Situation& situation,
                  const scene::World& world)
{
    const double tick_s = base::to_seconds(situation.tick);
    spring.force = {};
    spring.ages.fade(tick_s);
    const wire::BodyState* const there = owner != nullptr ? owner->body() : nullptr;
    const bool acts = spring.sent_at && there != nullptr && owner->freshness() > 0.0;
    if (spring.sent_at) {
        const base::Duration age = situation.now - *spring.sent_at;
        spring.ages.add(std::max(0.0, base::to_seconds(age)));
    }
    const double held_j = spring.stored_j();
    const double share = drag_of(world, situation.body) / static_cast<double>(springs_.size());
    const double stiffest =
        std::min(options_.stiffness_max_n_per_m, share / (spring.ages.seconds() + tick_s));
    spring.stiffness_n_per_m = acts ? owner->freshness() * stiffest : 0.0;
    if (acts) spring.stretch = (there->position - world.position(situation.body)).value;
    const double wanted_j = spring.stored_j();
    if (wanted_j > held_j + spring.tank_j) {
        spring.stretch *= std::sqrt((held_j + spring.tank_j) / wanted_j);
        spring.tank_j = 0.0;
    } else {
        spring.tank_j = std::min(options_.tank_j, spring.tank_j + held_j - wanted_j);
    }
    spring.force = spring.stiffness_n_per_m * spring.stretch;
}

/// Updates the energies after a tick: the body has moved toward the ends of the springs, and its
/// drag has dissipated at least drag * moved^2 / tick.
void Couple::settle_accounts(const glm::dvec3& moved, double drag, double tick_s)
{
    const double square = glm::dot(moved, moved);
    const double dissipated_j = drag * square / tick_s / static_cast<double>(springs_.size());
    for (Spring& spring : springs_) {
        // A force that is constant during a tick does more work than the spring loses; hence the
        // second term.
        const double given_j = glm::dot(spring.force, moved);
        const double before_j = spring.stored_j();
        spring.stretch -= moved;
        const double excess_j = given_j - (before_j - spring.stored_j());
        spring.tank_j = std::clamp(spring.tank_j + dissipated_j - excess_j, 0.0, options_.tank_j);
    }
}

Outcome Couple::tick(scene::World& world, const Situation& situation)
{
    const CombinedRemote remote = combined_remote(situation, BaseOptions{});
    const base::Position before = world.position(situation.body);
    // Once all hands are off, one copy moves to the other, and no spring acts in either copy.
    std::optional<CombinedRemote::Pose> rest;
    if (world.touch(own_hand).touching || remote.touching) {
        at_rest_.interrupt();
    } else {
        Situation either = situation;
        either.yields = true;
        rest = at_rest_.pose(before, remote, either);
    }
    glm::dvec3 sum{0.0};
    for (std::size_t i = 0; i < springs_.size(); ++i) {
        draw(springs_[i], rest ? nullptr : &situation.others[i], situation, world);
        sum += springs_[i].force;
    }
    if (sum != glm::dvec3{0.0}) world.push(situation.body, {sum});
    world.tick();
    const glm::dvec3 moved = (world.position(situation.body) - before).value;
    settle_accounts(moved, drag_of(world, situation.body), base::to_seconds(situation.tick));
    Outcome outcome;
    outcome.touched = world.touch(own_hand);
    outcome.on_hand = outcome.touched.on_hand;
    outcome.remote_touching = remote.touching;
    outcome.remote_force = {sum};
    if (const auto& state = situation.remote.state()) outcome.remote_hip = state->hip;
    if (rest && situation.yields && !outcome.touched.touching)
        world.place(situation.body, rest->position, rest->velocity);
    return outcome;
}

} // namespace hapnet::peer

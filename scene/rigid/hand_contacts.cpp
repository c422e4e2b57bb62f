// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/hand_contacts.hpp"

#include "scene/hand/spring.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

HandContacts::HandContacts(const WorldConfig& config)
    : any_felt_plane_{std::any_of(config.planes.begin(), config.planes.end(),
                                  [](const PlaneDescription& plane) { return plane.felt; })},
      gravity_reach_{config.tick * config.tick *
                     std::sqrt(glm::dot(config.gravity, config.gravity))},
      springs_{config.hands.count * touched_per_hand_max},
      forces_{config.hands.count * touched_per_hand_max},
      own_{config.hands.count * touched_per_hand_max},
      work_{config.hands.count * touched_per_hand_max}
{}

void HandContacts::begin_step(const WorldConfig& config, WorldState& state)
{
    springs_.clear();
    forces_.clear();
    for (std::uint32_t i = 0; i < config.hands.count; ++i) {
        for (std::size_t k = 0; k < hands_[i].count; ++k) hands_[i].nearby[k].is_current = false;
        state.touches[i] = {};
        const HandInput& input = state.hands[i];
        if (!input.present || !input.gripping) hands_[i].holding.reset();
    }
}

HandContacts::NearBody* HandContacts::find_near(Hand& hand, BodyId body)
{
    for (std::size_t i = 0; i < hand.count; ++i) {
        if (hand.nearby[i].body == body) return &hand.nearby[i];
    }
    if (hand.count == hand.nearby.size()) return nullptr;
    NearBody& fresh = hand.nearby[hand.count++];
    fresh = {};
    fresh.body = body;
    return &fresh;
}

void HandContacts::collide(const WorldConfig& config, WorldState& state, std::uint32_t hand,
                           const Target& target)
{
    if (target.is_movable && state.hands[hand].gripping && add_grip(config, state, hand, target))
        return;
    add_push(config, state, hand, target);
}

/// Whether the hand holds the body: then it pulls and pushes in all directions where it took hold.
bool HandContacts::add_grip(const WorldConfig& config, WorldState& state, std::uint32_t index,
                            const Target& target)
{
    const HandDescription& hands = config.feels.of(index, target.body, config.hands);
    const HandInput& input = state.hands[index];
    Hand& hand = hands_[index];
    const double apart = distance(target.box, input.position.value);
    if (!hand.holding) {
        if (apart > grip_distance(hands)) return false;
        hand.holding = Holding{target.body, to_local(target.box, input.position.value)};
    }
    if (hand.holding->body != target.body) return false;
    const glm::dvec3 arm = target.box.axes * hand.holding->at;
    HandSpring spring{.arm = arm,
                      .velocity = input.velocity.value,
                      .stiffness = hands.stiffness_n_per_m,
                      .damping = hands.damping_ns_per_m,
                      .force_max = hands.force_max_n,
                      .holds = true,
                      .stretch = input.position.value - (target.box.centre + arm)};
    const glm::dvec3 here = target.velocity + glm::cross(target.spin, arm);
    const base::Force wanted = grip_force(hands, spring.stretch, spring.velocity - here);
    HandTouch& touch = state.touches[index];
    touch.body = target.body;
    note_grip(touch, hands, apart, base::limited(wanted, hands.force_max_n));
    add(index, target.body) = spring;
    return true;
}

void HandContacts::add_push(const WorldConfig& config, WorldState& state, std::uint32_t index,
                            const Target& target)
{
    const HandDescription& hands = config.feels.of(index, target.body, config.hands);
    const HandInput& input = state.hands[index];
    NearBody* const near_body = find_near(hands_[index], target.body);
    if (near_body == nullptr) return;
    // Looks as far ahead as the two come nearer: a spring may begin to act within the tick.
    const glm::dvec3& centre = input.position.value;
    const double turning = sum_of_sizes(target.spin) * sum_of_sizes(target.box.half);
    const double ahead =
        config.tick * (sum_of_sizes(input.velocity.value - target.velocity) + turning) +
        0.5 * gravity_reach_;
    const glm::dvec3 place = to_local(target.box, centre);
    const auto overlap = near_body->memory.find(target.box.half, place, hands.radius_m + ahead,
                                                near_body->before ? &*near_body->before : nullptr);
    near_body->is_current = true;
    near_body->before = place;
    if (!overlap) return;
    const double depth = overlap->depth - ahead;
    const glm::dvec3 normal = target.box.axes * overlap->normal;
    const glm::dvec3 arm = target.box.axes * overlap->point;
    const glm::dvec3 here = target.velocity + glm::cross(target.spin, arm);
    const double closing = glm::dot(here - input.velocity.value, normal);
    HandTouch& touch = state.touches[index];
    note_push(touch, depth, force_at(hands, depth, closing) * normal);
    if (!target.is_movable) {
        const double impulse = impulse_at_constant_velocity(hands, depth, closing, config.tick);
        touch.on_hand.value += (impulse / config.tick) * normal;
        return;
    }
    // A spring that does not begin to act within the tick is left out; one that acts already stays,
    // also in the tick in which it ends.
    if (depth < 0.0 && -depth > closing * config.tick + gravity_reach_) return;
    HandSpring& spring = add(index, target.body);
    spring.normal = normal;
    spring.arm = arm;
    spring.radius = hands.radius_m;
    spring.gap = -depth;
    spring.velocity = input.velocity.value;
    spring.stiffness = hands.stiffness_n_per_m;
    spring.damping = hands.damping_ns_per_m;
    spring.force_max = hands.force_max_n;
    spring.is_amid_face = overlap->is_amid_face;
    spring.holds = false;
}

void HandContacts::feel_planes(const WorldConfig& config, WorldState& state,
                               std::uint32_t hand) const
{
    if (!any_felt_plane_) return;
    const HandInput& input = state.hands[hand];
    const HandDescription& feel = config.feels.of(hand, config.hands);
    for (const PlaneDescription& plane : config.planes) {
        if (!plane.felt) continue;
        const double depth =
            feel.radius_m + plane.offset_m - glm::dot(plane.normal, input.position.value);
        const double closing = -glm::dot(plane.normal, input.velocity.value);
        if (depth <= 0.0 && depth + config.tick * closing <= 0.0) continue;
        HandTouch& touch = state.touches[hand];
        note_push(touch, depth, force_at(feel, depth, closing) * plane.normal);
        const double impulse = impulse_at_constant_velocity(feel, depth, closing, config.tick);
        touch.on_hand.value += (impulse / config.tick) * plane.normal;
    }
}

HandSpring& HandContacts::add(std::uint32_t hand, BodyId body)
{
    springs_.add() = {hand, body, glm::dvec3{0.0}};
    return forces_.add();
}

HandContacts::BodySprings HandContacts::springs_on(BodyId body)
{
    const auto is_on = [body](const Spring& spring) { return spring.body == body; };
    const std::span<const Spring> all = springs();
    work_.resize(all.size());
    if (std::all_of(all.begin(), all.end(), is_on)) return {forces_.all(), work_.all()};
    own_.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (is_on(all[i])) own_.add() = forces_[i];
    }
    work_.resize(own_.size());
    return {own_.all(), work_.all()};
}

void HandContacts::store_impulses(BodyId body)
{
    std::size_t next = 0;
    for (Spring& spring : springs_.all()) {
        if (spring.body == body) spring.impulse = work_[next++].impulse;
    }
}

void HandContacts::forget_departed(std::uint32_t index)
{
    Hand& hand = hands_[index];
    std::size_t kept = 0;
    for (std::size_t i = 0; i < hand.count; ++i) {
        if (hand.nearby[i].is_current) hand.nearby[kept++] = hand.nearby[i];
    }
    hand.count = kept;
}

void HandContacts::report_forces(const WorldConfig& config, WorldState& state)
{
    const double rate = 1.0 / config.tick;
    for (const Spring& spring : springs()) {
        HandTouch& touch = state.touches[spring.hand];
        const base::Force force{rate * spring.impulse};
        touch.on_hand += -force;
        const double square = glm::dot(force.value, force.value);
        if (!(square > glm::dot(touch.on_body.value, touch.on_body.value))) continue;
        touch.touching = true;
        touch.body = spring.body;
        touch.on_body = force;
    }
    for (std::uint32_t i = 0; i < config.hands.count; ++i) {
        state.touches[i].touching = state.touches[i].touching || state.touches[i].holding;
    }
}

void HandContacts::forget(BodyId body)
{
    for (Hand& hand : hands_) {
        if (hand.holding && hand.holding->body == body) hand.holding.reset();
        for (std::size_t i = 0; i < hand.count; ++i) {
            if (hand.nearby[i].body != body) continue;
            hand.nearby[i] = hand.nearby[--hand.count];
            break;
        }
    }
}

} // namespace hapnet::scene

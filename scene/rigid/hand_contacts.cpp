// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/hand_contacts.hpp"

#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::scene {

namespace {

/// The spring and damper alone, at one moment.
double force_at(const HipDescription& hips, double depth, double closing)
{
    if (depth <= 0.0) return 0.0;
    return std::clamp(hips.stiffness_n_per_m * depth + hips.damping_ns_per_m * closing, 0.0,
                      hips.force_max_n);
}

/// The mean over a time of a number that changes evenly, limited to [0, most].
double mean_limited(double from, double to, double most)
{
    const double low = std::min(from, to);
    const double high = std::max(from, to);
    if (low >= most) return most;
    if (high <= 0.0) return 0.0;
    if (low >= 0.0 && high <= most) return 0.5 * (from + to);
    const double inner_low = std::max(low, 0.0);
    const double inner_high = std::min(high, most);
    const double inside = (inner_high - inner_low) * 0.5 * (inner_high + inner_low);
    const double above = high > most ? (high - most) * most : 0.0;
    return (inside + above) / (high - low);
}

/// The mean force on what does not move, of a hand that comes nearer at a constant speed.
double steady_force(const HipDescription& hips, double depth, double closing, double tick)
{
    const double end = depth + closing * tick;
    if (depth <= 0.0 && end <= 0.0) return 0.0;
    double share = 1.0;
    double from = depth;
    double to = end;
    if (depth < 0.0) {
        share = end / (end - depth);
        from = 0.0;
    } else if (end < 0.0) {
        share = depth / (depth - end);
        to = 0.0;
    }
    const double damper = hips.damping_ns_per_m * closing;
    return share * mean_limited(hips.stiffness_n_per_m * from + damper,
                                hips.stiffness_n_per_m * to + damper, hips.force_max_n);
}

} // namespace

HandSprings::HandSprings(const Frozen& frozen)
    : fall_{frozen.tick * frozen.tick * std::sqrt(glm::dot(frozen.gravity, frozen.gravity))},
      springs_{frozen.hips.count * touched_per_hand_max},
      forms_{frozen.hips.count * touched_per_hand_max},
      own_{frozen.hips.count * touched_per_hand_max},
      work_{frozen.hips.count * touched_per_hand_max}
{}

void HandSprings::begin(const Frozen& frozen, Stage& stage)
{
    springs_.clear();
    forms_.clear();
    for (std::uint32_t i = 0; i < frozen.hips.count; ++i) {
        for (std::size_t k = 0; k < hands_[i].count; ++k) hands_[i].near[k].is_there = false;
        stage.touches[i] = {};
        const HipInput& hip = stage.hips[i];
        if (!hip.present || !hip.gripping) hands_[i].holding.reset();
    }
}

HandSprings::Near* HandSprings::near(Hand& hand, BodyId body)
{
    for (std::size_t i = 0; i < hand.count; ++i) {
        if (hand.near[i].body == body) return &hand.near[i];
    }
    if (hand.count == hand.near.size()) return nullptr;
    Near& fresh = hand.near[hand.count++];
    fresh = {};
    fresh.body = body;
    return &fresh;
}

void HandSprings::touch(const Frozen& frozen, Stage& stage, std::uint32_t hand,
                        const Target& target)
{
    if (target.is_movable && stage.hips[hand].gripping && hold(frozen, stage, hand, target)) return;
    press(frozen, stage, hand, target);
}

/// Whether the hand holds the body: then it pulls and pushes in all directions where it took hold.
bool HandSprings::hold(const Frozen& frozen, Stage& stage, std::uint32_t index,
                       const Target& target)
{
    const HipDescription& hips = frozen.hips;
    const HipInput& hip = stage.hips[index];
    Hand& hand = hands_[index];
    const double apart = distance(target.box, hip.position.value);
    if (!hand.holding) {
        if (apart > hips.radius_m + hips.grip_reach_m) return false;
        hand.holding = Holding{target.body, seen_from(target.box, hip.position.value)};
    }
    if (hand.holding->body != target.body) return false;
    const glm::dvec3 arm = target.box.axes * hand.holding->at;
    HipSpring spring{.arm = arm,
                     .velocity = hip.velocity.value,
                     .stiffness = hips.stiffness_n_per_m,
                     .damping = hips.damping_ns_per_m,
                     .force_max = hips.force_max_n,
                     .holds = true,
                     .stretch = hip.position.value - (target.box.centre + arm)};
    const glm::dvec3 here = target.velocity + glm::cross(target.spin, arm);
    const base::Force wanted{spring.stiffness * spring.stretch +
                             spring.damping * (spring.velocity - here)};
    const base::Force force = base::limited(wanted, hips.force_max_n);
    HipTouch& touch = stage.touches[index];
    touch.holding = true;
    touch.body = target.body;
    touch.depth_m = std::max(touch.depth_m, std::max(hips.radius_m - apart, 0.0));
    touch.on_hip_at_start += -force;
    add(index, target.body) = spring;
    return true;
}

void HandSprings::press(const Frozen& frozen, Stage& stage, std::uint32_t index,
                        const Target& target)
{
    const HipDescription& hips = frozen.hips;
    const HipInput& hip = stage.hips[index];
    Near* const near_by = near(hands_[index], target.body);
    if (near_by == nullptr) return;
    // Looks as far ahead as the two come nearer: a spring may begin to act within the tick.
    const glm::dvec3& centre = hip.position.value;
    const double turning = sum_of_sizes(target.spin) * sum_of_sizes(target.box.half);
    const double ahead =
        frozen.tick * (sum_of_sizes(hip.velocity.value - target.velocity) + turning) + 0.5 * fall_;
    const glm::dvec3 place = seen_from(target.box, centre);
    const auto overlap = near_by->memory.find(target.box.half, place, hips.radius_m + ahead,
                                              near_by->before ? &*near_by->before : nullptr);
    near_by->is_there = true;
    near_by->before = place;
    if (!overlap) return;
    const double depth = overlap->depth - ahead;
    const glm::dvec3 normal = target.box.axes * overlap->normal;
    const glm::dvec3 arm = target.box.axes * overlap->point;
    const glm::dvec3 here = target.velocity + glm::cross(target.spin, arm);
    const double closing = glm::dot(here - hip.velocity.value, normal);
    HipTouch& touch = stage.touches[index];
    touch.depth_m = std::max(touch.depth_m, depth);
    touch.on_hip_at_start.value += force_at(hips, depth, closing) * normal;
    if (!target.is_movable) {
        touch.on_hip.value += steady_force(hips, depth, closing, frozen.tick) * normal;
        return;
    }
    // What does not begin to act within the tick is no spring; what acts already is one, also in
    // the tick in which it ends.
    if (depth < 0.0 && -depth > closing * frozen.tick + fall_) return;
    HipSpring& spring = add(index, target.body);
    spring.normal = normal;
    spring.arm = arm;
    spring.radius = hips.radius_m;
    spring.gap = -depth;
    spring.velocity = hip.velocity.value;
    spring.stiffness = hips.stiffness_n_per_m;
    spring.damping = hips.damping_ns_per_m;
    spring.force_max = hips.force_max_n;
    spring.is_amid_face = overlap->is_amid_face;
    spring.holds = false;
}

HipSpring& HandSprings::add(std::uint32_t hand, BodyId body)
{
    springs_.add() = {hand, body, glm::dvec3{0.0}};
    return forms_.add();
}

HandSprings::OnBody HandSprings::on(BodyId body)
{
    const auto is_on = [body](const Spring& spring) { return spring.body == body; };
    const std::span<const Spring> all = springs();
    work_.resize(all.size());
    if (std::all_of(all.begin(), all.end(), is_on)) return {forms_.all(), work_.all()};
    own_.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (is_on(all[i])) own_.add() = forms_[i];
    }
    work_.resize(own_.size());
    return {own_.all(), work_.all()};
}

void HandSprings::worked(BodyId body)
{
    std::size_t next = 0;
    for (Spring& spring : springs_.all()) {
        if (spring.body == body) spring.impulse = work_[next++].impulse;
    }
}

void HandSprings::end(std::uint32_t index)
{
    Hand& hand = hands_[index];
    std::size_t kept = 0;
    for (std::size_t i = 0; i < hand.count; ++i) {
        if (hand.near[i].is_there) hand.near[kept++] = hand.near[i];
    }
    hand.count = kept;
}

void HandSprings::report(const Frozen& frozen, Stage& stage)
{
    const double rate = 1.0 / frozen.tick;
    for (const Spring& spring : springs()) {
        HipTouch& touch = stage.touches[spring.hand];
        const base::Force force{rate * spring.impulse};
        touch.on_hip += -force;
        const double square = glm::dot(force.value, force.value);
        if (!(square > glm::dot(touch.on_body.value, touch.on_body.value))) continue;
        touch.touching = true;
        touch.body = spring.body;
        touch.on_body = force;
    }
    for (std::uint32_t i = 0; i < frozen.hips.count; ++i) {
        stage.touches[i].touching = stage.touches[i].touching || stage.touches[i].holding;
    }
}

void HandSprings::forget(BodyId body)
{
    for (Hand& hand : hands_) {
        if (hand.holding && hand.holding->body == body) hand.holding.reset();
        for (std::size_t i = 0; i < hand.count; ++i) {
            if (hand.near[i].body != body) continue;
            hand.near[i] = hand.near[--hand.count];
            break;
        }
    }
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/hand_contacts.hpp"

#include "scene/collide/distance.hpp"
#include "scene/hand/midpoint.hpp"
#include "scene/hand/spring.hpp"
#include "scene/maths/vector.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace hapnet::scene {

HandContacts::HandContacts(const WorldConfig& config)
    : hands_(config.hands.count),
      any_felt_plane_{std::any_of(config.planes.begin(), config.planes.end(),
                                  [](const PlaneDescription& plane) { return plane.felt; })},
      any_friction_{config.feels.any_friction()},
      gravity_reach_{config.tick * config.tick *
                     std::sqrt(glm::dot(config.gravity, config.gravity))},
      springs_{config.hands.count * touched_per_hand_max},
      forces_{config.hands.count * touched_per_hand_max},
      own_{config.hands.count * touched_per_hand_max},
      work_{config.hands.count * touched_per_hand_max},
      proxies_{config},
      rubbed_{any_friction_ ? config.hands.count * touched_per_hand_max : 0},
      frictions_{any_friction_ ? config.hands.count * touched_per_hand_max : 0}
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

HandContacts::NearBody* HandContacts::find_near(Hand& hand, PartId part)
{
    for (std::size_t i = 0; i < hand.count; ++i) {
        if (hand.nearby[i].part == part) return &hand.nearby[i];
    }
    if (hand.count == hand.nearby.size()) return nullptr;
    NearBody& fresh = hand.nearby[hand.count++];
    fresh = {};
    fresh.part = part;
    return &fresh;
}

void HandContacts::collide(const WorldConfig& config, WorldState& state, std::uint32_t hand,
                           const Target& target)
{
    if (target.is_movable && state.hands[hand].gripping) {
        if (add_grip(config, state, hand, target)) return;
        const std::optional<Holding>& holding = hands_[hand].holding;
        if (holding && holding->body == target.body) return; // the hand holds another part
    }
    add_push(config, state, hand, target);
}

/// True if the hand holds the body. Then it pulls and pushes in all directions at the point where
/// it gripped.
bool HandContacts::add_grip(const WorldConfig& config, WorldState& state, std::uint32_t index,
                            const Target& target)
{
    const HandDescription& hands = config.feels.of(index, target.body, config.hands);
    const HandInput& input = state.hands[index];
    Hand& hand = hands_[index];
    const OrientedBox& box = target.now.box;
    const double apart = distance(box, input.position.value);
    if (!hand.holding) {
        if (apart > grip_distance(hands) || !has_room(config, index, target)) return false;
        hand.holding = Holding{target.body, target.part, to_local(box, input.position.value)};
    }
    if (hand.holding->part != target.part) return false;
    const glm::dvec3 held = box.axes * hand.holding->at;
    const glm::dvec3 arm = target.with_parts == nullptr ? held : held + target.now.offset;
    HandSpring spring{.arm = arm,
                      .velocity = input.velocity.value,
                      .stiffness = hands.stiffness_n_per_m,
                      .damping = hands.damping_ns_per_m,
                      .force_max = hands.force_max_n,
                      .holds = true,
                      .stretch = input.position.value - (box.centre + held)};
    const glm::dvec3 here = target.velocity + glm::cross(target.now.spin, arm);
    const base::Force wanted = grip_force(hands, spring.stretch, spring.velocity - here);
    HandTouch& touch = state.touches[index];
    touch.body = target.body;
    note_grip(touch, hands, apart, base::limited(wanted, hands.force_max_n));
    add(index, target) = spring;
    return true;
}

/// Sets the geometry of a press on a face. `offset` is the hand's place from the body's centre.
inline void HandContacts::press(const AmidFace& face, const glm::dvec3& offset, HandSpring& spring)
{
    const double gap = glm::dot(face.normal, offset) - face.half;
    spring.normal = face.normal;
    spring.arm = offset - gap * face.normal;
    spring.gap = gap - spring.radius;
    spring.is_amid_face = true;
}

/// Finds where the hand's sphere overlaps a body's box, or may overlap it within the tick. Returns
/// false if it does neither.
inline bool HandContacts::touch(const WorldConfig& config, const HandInput& input,
                                const Target& target, NearBody& near_body, HandSpring& spring) const
{
    near_body.is_current = true;
    if (target.with_parts != nullptr) return find_on_part(config, input, target, near_body, spring);
    const AmidFace& amid = near_body.amid;
    const glm::dvec3 offset = input.position.value - target.now.box.centre;
    // Usually the hand presses the face that it pressed before.
    if (amid.turns == target.now.turns && sum_of_sizes(offset - amid.offset) <= amid.room) {
        press(amid, offset, spring);
        if (spring.gap < 0.0 && spring.gap > -spring.radius) {
            near_body.offset = offset;
            return true;
        }
    }
    return find(config, input, target, near_body, spring);
}

/// As find(), on one of several parts. The arm starts at the body's centre.
bool HandContacts::find_on_part(const WorldConfig& config, const HandInput& input,
                                const Target& target, NearBody& near_body, HandSpring& spring) const
{
    if (!find(config, input, target, near_body, spring)) return false;
    spring.arm += target.now.offset;
    spring.part = target.shape();
    spring.is_amid_face = false;
    return !is_inner(input, target, spring);
}

/// True if the point that the hand touches lies within or on another part, and the hand is at least
/// as deep in that part. Then that part pushes the hand, so that two faces that lie flush feel like
/// one. Of parts at the same depth, the one with the lower id pushes.
bool HandContacts::is_inner(const HandInput& input, const Target& target, const HandSpring& spring)
{
    const Bodies& bodies = *target.with_parts;
    const glm::dvec3 point = target.centre() + spring.arm;
    constexpr double flush = 1e-9;
    bool is_inner = false;
    bodies.for_parts(target.body, [&](PartId part) {
        if (part == target.part || is_inner) return;
        const OrientedBox other = shape_of(bodies, part);
        if (separation(point, other).distance > flush * bodies.parts[part].radius) return;
        const double gap = separation(input.position.value, other).distance - spring.radius;
        const double slack = flush * spring.radius;
        is_inner = part < target.part ? gap <= spring.gap + slack : gap < spring.gap - slack;
    });
    return is_inner;
}

bool HandContacts::find(const WorldConfig& config, const HandInput& input, const Target& target,
                        NearBody& near_body, HandSpring& spring) const
{
    const OrientedBox& box = target.now.box;
    if (box.is_round()) return find_round(config, input, target, spring);
    const glm::dvec3 offset = input.position.value - box.centre;
    const glm::dvec3 before = near_body.offset * near_body.axes; // in the body's frame
    const glm::dvec3 here = offset * box.axes;
    const bool has_before = std::exchange(near_body.has_before, true);
    near_body.offset = offset;
    near_body.axes = box.axes;
    AmidFace& amid = near_body.amid;
    amid.room = -1.0;
    // The look-ahead is the distance by which the two approach: a spring may begin to act within
    // the tick.
    const double turning =
        sum_of_sizes(target.now.spin) * (sum_of_sizes(box.half) + sum_of_sizes(target.now.offset));
    const double ahead =
        config.tick * (sum_of_sizes(input.velocity.value - target.velocity) + turning) +
        0.5 * gravity_reach_;
    auto overlap = near_body.memory.find(box.half, here, spring.radius + ahead,
                                         has_before ? &before : nullptr);
    const bool has_internal = config.internal_faces.has(target.part);
    if (overlap && has_internal) {
        const double reach = spring.radius + ahead;
        overlap =
            outer_overlap(config.internal_faces, target, {near_body.memory, here, reach}, *overlap);
    }
    if (!overlap) return false;
    if (!overlap->is_amid_face || has_internal) {
        spring.normal = box.axes * overlap->normal;
        spring.arm = box.axes * overlap->point;
        spring.gap = ahead - overlap->depth;
        spring.is_amid_face = false;
        return true;
    }
    const BoxFace face = *near_body.memory.entered();
    const PerAxis half = per_axis(box.half), place = per_axis(here);
    double room = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        if (i != face.axis) room = std::min(room, amid_face_share * half[i] - std::abs(place[i]));
    }
    constexpr double all_but_rounding = 0.999;
    amid = {target.now.turns, offset, all_but_rounding * room,
            static_cast<double>(face.sign) * box.axes[face.axis], half[face.axis]};
    press(amid, offset, spring);
    return true;
}

/// Returns the part of an overlap that remains where faces are internal. Behind an internal face
/// the nearest outer face pushes, and beside it the neighbour does.
std::optional<LocalOverlap> HandContacts::outer_overlap(const InternalFaces& internal,
                                                        const Target& target, const FoundNear& near,
                                                        const LocalOverlap& found)
{
    constexpr double lean = 1e-7;
    const glm::dvec3& half = target.now.box.half;
    LocalOverlap overlap = found;
    if (internal.leads_inside(target.part, half, found, lean)) {
        const glm::dvec3 beyond = glm::abs(near.place) - half;
        // A point on the border counts as inside: is_shared() leaves the point to one of two
        // neighbours.
        constexpr double border = 2e-12;
        const double most = border * std::max({half.x, half.y, half.z});
        if (std::max({beyond.x, beyond.y, beyond.z}) > most) return std::nullopt;
        const auto face = internal.nearest_outer_face(target.part, half, near.place);
        if (!face) return std::nullopt;
        overlap = near.memory.enter(*face, half, near.place, near.radius);
    }
    if (internal.is_shared(target.part, overlap)) return std::nullopt;
    return overlap;
}

/// Finds the spring on a sphere or a capsule, by the nearest point of its core.
bool HandContacts::find_round(const WorldConfig& config, const HandInput& input,
                              const Target& target, HandSpring& spring) const
{
    const OrientedBox& body = target.now.box;
    const Separation apart = separation(input.position.value, core_of(body));
    const double turning =
        sum_of_sizes(target.now.spin) * (sum_of_sizes(body.half) + sum_of_sizes(target.now.offset));
    spring.normal = apart.direction;
    spring.arm = apart.on_second - body.centre + body.rounding * spring.normal;
    spring.gap = apart.distance - body.rounding - spring.radius;
    spring.is_amid_face = false;
    const double ahead =
        config.tick * (sum_of_sizes(input.velocity.value - target.velocity) + turning) +
        0.5 * gravity_reach_;
    return spring.gap < ahead;
}

void HandContacts::add_push(const WorldConfig& config, WorldState& state, std::uint32_t index,
                            const Target& target)
{
    const HandDescription& hands = config.feels.of(index, target.body, config.hands);
    const HandInput& input = state.hands[index];
    NearBody* const near_body = find_near(hands_[index], target.part);
    if (near_body == nullptr) return;
    HandSpring& spring = forces_.add();
    spring.radius = hands.radius_m;
    spring.part = nullptr;
    if (!touch(config, input, target, *near_body, spring)) {
        forces_.drop_last();
        return;
    }
    const double depth = -spring.gap;
    const glm::dvec3 here = target.velocity + glm::cross(target.now.spin, spring.arm);
    const double closing = glm::dot(here - input.velocity.value, spring.normal);
    HandTouch& touch = state.touches[index];
    note_push(touch, depth, force_at(hands, depth, closing) * spring.normal);
    if (!target.is_movable) {
        const double impulse = impulse_at_constant_velocity(hands, depth, closing, config.tick);
        touch.on_hand.value += (impulse / config.tick) * spring.normal;
    }
    // A spring that does not begin to act within the tick is left out. One that acts already stays,
    // also in the tick in which it ends.
    const bool is_idle = depth < 0.0 && -depth > closing * config.tick + gravity_reach_;
    if (!target.is_movable || is_idle || !has_room(config, index, target)) {
        forces_.drop_last();
        return;
    }
    spring.velocity = input.velocity.value;
    spring.stiffness = hands.stiffness_n_per_m;
    spring.damping = hands.damping_ns_per_m;
    spring.force_max = hands.force_max_n;
    spring.holds = false;
    springs_.add() = {index, target.body, glm::dvec3{0.0}, target.part,
                      target.with_parts != nullptr};
}

bool HandContacts::may_press_again(const WorldConfig& config)
{
    const std::span<const Spring> all = springs();
    if (all.empty() || all.size() > 2) return false;
    const Spring& a = all.front();
    const Spring& b = all.back();
    const HandSpring& one = forces_[0];
    const HandSpring& two = forces_[all.size() - 1];
    if (!one.is_amid_face || !two.is_amid_face || a.body != b.body) return false;
    for (std::uint32_t i = 0; i < config.hands.count; ++i) {
        const std::size_t presses = i == a.hand || i == b.hand ? 1 : 0;
        if (hands_[i].holding || hands_[i].count != presses) return false;
    }
    pressing_ = PressingHands{a.body,
                              {a.hand, hands_[a.hand].nearby[0].amid, one},
                              {b.hand, hands_[b.hand].nearby[0].amid, two}};
    return one.stiffness > 0.0 && two.stiffness > 0.0;
}

bool HandContacts::press_again(const WorldState& state, const SweptBox& now,
                               const glm::dvec3& velocity)
{
    const std::optional<TwoVectors> offsets = pressing_.press(state, now, velocity);
    if (!offsets) return false;
    hands_[pressing_.hand(0)].nearby[0].offset = first(*offsets);
    hands_[pressing_.hand(1)].nearby[0].offset = second(*offsets);
    return true;
}

void HandContacts::feel_planes(const WorldConfig& config, WorldState& state)
{
    for (std::uint32_t hand = 0; hand < config.hands.count; ++hand) {
        if (state.hands[hand].present) feel_planes_with(config, state, hand);
    }
}

void HandContacts::feel_planes_with(const WorldConfig& config, WorldState& state,
                                    std::uint32_t hand)
{
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

/// Notes the force that the hand feels at the start of the tick, and limits its push to the part
/// that friction leaves.
void HandContacts::note_friction(WorldState& state, const HandProxies::Touch& touch,
                                 const FrictionSpring& friction, const Press& press)
{
    const HandDescription& hands = press.hands;
    const double before = force_at(hands, press.depth, press.closing);
    const double push = std::min(before, push_max(hands.force_max_n, friction.limits));
    const glm::dvec3 pull =
        hands.stiffness_n_per_m * friction.stretch + hands.damping_ns_per_m * press.velocity;
    const double size = length(pull);
    const double most = friction.limit() * push;
    const glm::dvec3 cut = size > most ? (most / size) * pull : pull;
    state.touches[touch.hand].on_hand_at_start.value += (push - before) * touch.normal - cut;
    HandSlip& slip = state.slips[touch.hand];
    const double stretch = length(friction.stretch);
    slip.stretch_m = std::max(slip.stretch_m, stretch);
    slip.stored_j += 0.5 * hands.stiffness_n_per_m * stretch * stretch;
}

void HandContacts::note_slip(HandSlip& slip, const FrictionSpring& friction)
{
    slip.sticks = slip.sticks || !friction.slides;
    slip.slides = slip.slides || friction.slides;
}

void HandContacts::rub_movable(const WorldConfig& config, WorldState& state, std::size_t spring,
                               const Target& target)
{
    const auto [hand, body, impulse, part, is_on_part] = springs_[spring];
    const HandSpring& form = forces_[spring];
    const HandInput& input = state.hands[hand];
    RubbedSpring& rubbed = rubbed_.add();
    const OrientedBox& box = target.now.box;
    rubbed.touch = {hand,     part,        box.axes,      input.position.value - target.centre(),
                    form.arm, form.normal, form.gap < 0.0};
    rubbed.friction = form.holds
                          ? FrictionSpring{}
                          : proxies_.begin(rubbed.touch, config.feels.friction_on_body(hand, body));
    if (!rubbed.friction.limits.is_rough()) return;
    const glm::dvec3 over =
        input.velocity.value - target.velocity - glm::cross(target.now.spin, form.arm);
    const double closing = -glm::dot(over, form.normal);
    note_friction(state, rubbed.touch, rubbed.friction,
                  {config.feels.of(hand, body, config.hands), over + closing * form.normal,
                   -form.gap, closing});
}

void HandContacts::rub_fixed(const WorldConfig& config, WorldState& state, std::uint32_t hand,
                             const Target& target)
{
    const HandFriction limits = config.feels.friction_on_body(hand, target.body);
    NearBody* const near_body = find_near(hands_[hand], target.part);
    if (!limits.is_rough() || near_body == nullptr) return;
    const HandDescription& hands = config.feels.of(hand, target.body, config.hands);
    const HandInput& input = state.hands[hand];
    HandSpring spring{.radius = hands.radius_m};
    if (!touch(config, input, target, *near_body, spring)) return;
    const OrientedBox& box = target.now.box;
    const glm::dvec3 over =
        input.velocity.value - target.velocity - glm::cross(target.now.spin, spring.arm);
    const double closing = -glm::dot(over, spring.normal);
    rub_unmoved(config, state,
                {hand, target.part, box.axes, input.position.value - target.centre(), spring.arm,
                 spring.normal, spring.gap < 0.0},
                limits, {hands, over + closing * spring.normal, -spring.gap, closing});
}

void HandContacts::rub_planes(const WorldConfig& config, WorldState& state, std::uint32_t hand)
{
    const HandInput& input = state.hands[hand];
    const HandDescription& feel = config.feels.of(hand, config.hands);
    const glm::dvec3& centre = input.position.value;
    for (std::uint32_t i = 0; i < config.planes.size(); ++i) {
        const PlaneDescription& plane = config.planes[i];
        const HandFriction limits = config.feels.friction_on_plane(hand, i);
        if (!plane.felt || !limits.is_rough()) continue;
        const double height = glm::dot(plane.normal, centre) - plane.offset_m;
        const double depth = feel.radius_m - height;
        const double closing = -glm::dot(plane.normal, input.velocity.value);
        if (depth <= 0.0 && depth + config.tick * closing <= 0.0) continue;
        rub_unmoved(config, state,
                    {hand, HandProxies::planes_from + i, glm::dmat3{1.0}, centre,
                     centre - height * plane.normal, plane.normal, depth > 0.0},
                    limits, {feel, input.velocity.value + closing * plane.normal, depth, closing});
    }
}

/// Adds the friction of a hand on something whose motion the hands do not change.
void HandContacts::rub_unmoved(const WorldConfig& config, WorldState& state,
                               const HandProxies::Touch& touch, const HandFriction& limits,
                               const Press& press)
{
    FrictionSpring friction = proxies_.begin(touch, limits);
    if (!friction.limits.is_rough()) return;
    note_friction(state, touch, friction, press);
    HandDescription hands = press.hands;
    const double tick = config.tick;
    const double before = impulse_at_constant_velocity(hands, press.depth, press.closing, tick);
    hands.force_max_n = push_max(hands.force_max_n, limits);
    const double push = impulse_at_constant_velocity(hands, press.depth, press.closing, tick);
    const glm::dvec3 pull = rub_evenly(
        {hands.stiffness_n_per_m, hands.damping_ns_per_m, press.velocity, push, tick}, friction);
    state.touches[touch.hand].on_hand.value +=
        (1.0 / tick) * ((push - before) * touch.normal + pull);
    proxies_.end(touch, friction);
    note_slip(state.slips[touch.hand], friction);
}

std::span<FrictionSpring> HandContacts::frictions_on(BodyId body)
{
    if (!any_friction_) return {};
    frictions_.clear();
    bool any = false;
    for (std::size_t i = 0; i < springs_.size(); ++i) {
        if (springs_[i].body != body) continue;
        frictions_.add() = rubbed_[i].friction;
        any = any || rubbed_[i].friction.limits.is_rough();
    }
    return any ? frictions_.all() : std::span<FrictionSpring>{};
}

void HandContacts::store_friction(WorldState& state, BodyId body)
{
    std::size_t next = 0;
    for (std::size_t i = 0; i < springs_.size(); ++i) {
        if (springs_[i].body != body) continue;
        const FrictionSpring& friction = frictions_[next++];
        if (!friction.limits.is_rough()) continue;
        proxies_.end(rubbed_[i].touch, friction);
        note_slip(state.slips[springs_[i].hand], friction);
    }
}

/// True if a body can take another spring. It takes as many as there can be hands. So one hand may
/// push several parts of it only as long as a spring is left for each later hand.
bool HandContacts::has_room(const WorldConfig& config, std::uint32_t index,
                            const Target& target) const
{
    if (target.with_parts == nullptr) return true;
    std::size_t all = 0, own = 0;
    for (const Spring& spring : springs_.all()) {
        if (spring.body != target.body) continue;
        ++all;
        if (spring.hand == index) ++own;
    }
    return own == 0 || all + (config.hands.count - 1 - index) < MidpointBudget::springs_max;
}

HandSpring& HandContacts::add(std::uint32_t hand, const Target& target)
{
    springs_.add() = {hand, target.body, glm::dvec3{0.0}, target.part,
                      target.with_parts != nullptr};
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

const HandContacts::Spring& HandContacts::first_spring_on(BodyId body) const
{
    const std::span<const Spring> all = springs_.all();
    return *std::find_if(all.begin(), all.end(),
                         [body](const Spring& spring) { return spring.body == body; });
}

void HandContacts::forget_departed(std::uint32_t index)
{
    Hand& hand = hands_[index];
    std::size_t kept = 0;
    for (std::size_t i = 0; i < hand.count; ++i) {
        if (!hand.nearby[i].is_current) continue;
        if (kept != i) hand.nearby[kept] = hand.nearby[i];
        ++kept;
    }
    hand.count = kept;
}

/// Returns the impulse of one hand on a body, by all its springs there.
glm::dvec3 HandContacts::impulse_on_body(const Spring& one) const
{
    glm::dvec3 sum{0.0};
    for (const Spring& spring : springs_.all())
        if (spring.hand == one.hand && spring.body == one.body) sum += spring.impulse;
    return sum;
}

void HandContacts::report_forces(const WorldConfig& config, WorldState& state)
{
    const double rate = 1.0 / config.tick;
    for (const Spring& spring : springs()) {
        HandTouch& touch = state.touches[spring.hand];
        base::Force force{rate * spring.impulse};
        touch.on_hand += -force;
        if (spring.is_on_part) force.value = rate * impulse_on_body(spring);
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

void HandContacts::forget(const Bodies& bodies, BodyId body)
{
    bodies.for_parts(body, [this](PartId part) {
        proxies_.forget(part);
        for (Hand& hand : hands_) {
            if (hand.holding && hand.holding->part == part) hand.holding.reset();
            for (std::size_t i = 0; i < hand.count; ++i) {
                if (hand.nearby[i].part != part) continue;
                hand.nearby[i] = hand.nearby[--hand.count];
                break;
            }
        }
    });
}

} // namespace hapnet::scene

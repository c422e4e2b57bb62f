// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/collide/pair_finder.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::scene {

namespace {

// The average number of pairs per body. In a disordered heap of cubes of one size, about 20 cubes
// are within the fat box of each: ten pairs per cube. The limit is three times that.
constexpr std::uint64_t pairs_per_body_max = 32;
// The number of planes near a body at the same time: those of the corner of a room, and some more.
constexpr std::uint64_t planes_per_body_max = 8;
// The number of ticks for which a hand that keeps its velocity stays in its box.
constexpr double hand_look_ahead_ticks = 32.0;
// The box reaches no farther ahead than this times the hand's radius, unless the hand is faster.
constexpr double hand_stretch_max = 16.0;

PairSet::Room room_for_bodies(const Bodies& bodies)
{
    const std::uint64_t movable = bodies.movable_parts();
    const std::uint64_t fixed = bodies.parts_count() - movable;
    const std::uint64_t all =
        movable * (movable - std::min<std::uint64_t>(movable, 1)) / 2 + movable * fixed;
    const std::uint64_t bound = std::min(all, movable * pairs_per_body_max);
    return {bodies.parts_count(), bodies.parts_count(), static_cast<std::uint32_t>(bound)};
}

PairSet::Room room_for_planes(const Bodies& bodies, std::size_t planes)
{
    const std::uint64_t each = std::min<std::uint64_t>(planes, planes_per_body_max);
    return {bodies.parts_count(), static_cast<std::uint32_t>(planes),
            static_cast<std::uint32_t>(bodies.movable_parts() * each)};
}

std::vector<Aabb> first_boxes(FatAabbs& fat, const Bodies& bodies)
{
    std::vector<Aabb> boxes(bodies.parts_count());
    for (Slot slot = 0; slot < bodies.size(); ++slot) {
        const Aabb whole = fat.renew(bodies, slot);
        bodies.for_parts(bodies.properties[slot].id,
                         [&](PartId part) { boxes[part] = fat.around(bodies, part, whole); });
    }
    return boxes;
}

/// True if the lowest corner of a box is not above a plane.
bool reaches(const Aabb& box, const PlaneDescription& plane)
{
    const glm::dvec3 half = 0.5 * box.size();
    const double radius = glm::dot(glm::abs(plane.normal), half);
    return glm::dot(plane.normal, box.centre()) - plane.offset_m <= radius;
}

} // namespace

template <BroadPhase broad_phase>
PairFinder<broad_phase>::PairFinder(const WorldConfig& config, const Bodies& bodies)
    : planes_of_scene_{config.planes},
      has_parts_{!bodies.parts.empty()},
      fat_boxes_{config, bodies},
      boxes_{first_boxes(fat_boxes_, bodies)},
      pairs_{room_for_bodies(bodies)},
      plane_pairs_{room_for_planes(bodies, config.planes.size())},
      moved_out_{bodies.movable},
      stamps_(bodies.parts_count(), 0)
{
    for (std::uint32_t hand = 0; hand < config.hands.count; ++hand)
        hands_.push_back({.box{glm::dvec3{1.0}, glm::dvec3{-1.0}},
                          .bodies = Bounded<PartId>{bodies.parts_count()}});
    for (Slot slot = 0; slot < bodies.movable; ++slot)
        bodies.for_parts(bodies.properties[slot].id,
                         [&](PartId part) { update_pairs(bodies, part); });
    apply_changes();
}

template <BroadPhase broad_phase>
void PairFinder<broad_phase>::update(const Bodies& bodies)
{
    if (has_left_out_) {
        has_left_out_ = false;
        for (Slot slot = 0; slot < bodies.awake; ++slot)
            bodies.for_parts(bodies.properties[slot].id,
                             [&](PartId part) { update_pairs(bodies, part); });
    }
    moved_out_.clear();
    fat_boxes_.find_moved_out(bodies, moved_out_);
    for (const Slot slot : moved_out_) renew(bodies, slot);
    for (Slot slot = bodies.movable; slot < bodies.moving; ++slot)
        if (fat_boxes_.has_moved_out(bodies, slot)) renew(bodies, slot);
    renewed_ += moved_out_.size();
    apply_changes();
}

/// Gives a body's parts new boxes, and updates their pairs.
template <BroadPhase broad_phase>
void PairFinder<broad_phase>::renew(const Bodies& bodies, Slot slot)
{
    const Aabb whole = fat_boxes_.renew(bodies, slot);
    const auto move = [&](PartId part, const Aabb& box) {
        boxes_.move(part, box);
        update_pairs(bodies, part);
        for (Hand& hand : hands_) update_hand(hand, part);
    };
    const BodyId id = bodies.properties[slot].id;
    if (!has_parts_) return move(id, whole);
    bodies.for_parts(id, [&](PartId part) { move(part, fat_boxes_.around(bodies, part, whole)); });
}

/// Renews the pairs of a part after its box was renewed.
template <BroadPhase broad_phase>
void PairFinder<broad_phase>::update_pairs(const Bodies& bodies, PartId id)
{
    const Aabb box = boxes_.box(id);
    const bool is_awake = bodies.slot_of[id] < bodies.awake;
    const bool is_kinematic = bodies.slot_of[id] >= bodies.movable;
    ++stamp_;
    const auto keep_if_near = [&](PairIndex index, PartId other) {
        if (overlap(box, boxes_.box(other)))
            stamps_[other] = stamp_;
        else
            pairs_.remove(index);
    };
    pairs_.for_first(id, [&](PairIndex index) { keep_if_near(index, pairs_[index].b); });
    pairs_.for_second(id, [&](PairIndex index) { keep_if_near(index, pairs_[index].a); });
    boxes_.for_overlapping(id, [&](PartId other) {
        if (other == id || stamps_[other] == stamp_) return;
        if (is_kinematic && bodies.slot_of[other] >= bodies.movable) return;
        if (has_parts_ && bodies.body_of(id) == bodies.body_of(other)) return;
        const bool is_active = is_awake || bodies.slot_of[other] < bodies.awake;
        if (!pairs_.add(std::min(id, other), std::max(id, other), is_active)) has_left_out_ = true;
    });
    if (!is_kinematic) update_plane_pairs(box, id, is_awake);
}

template <BroadPhase broad_phase>
void PairFinder<broad_phase>::update_plane_pairs(const Aabb& box, PartId id, bool is_awake)
{
    std::uint64_t known = 0;
    plane_pairs_.for_first(id, [&](PairIndex index) {
        const std::uint32_t plane = plane_pairs_[index].b;
        if (reaches(box, planes_of_scene_[plane]))
            known |= std::uint64_t{1} << plane;
        else
            plane_pairs_.remove(index);
    });
    for (std::uint32_t plane = 0; plane < planes_of_scene_.size(); ++plane)
        if ((known >> plane & 1U) == 0 && reaches(box, planes_of_scene_[plane]))
            if (!plane_pairs_.add(id, plane, is_awake)) has_left_out_ = true;
}

/// Adds a part to those in a hand's box, or removes it.
template <BroadPhase broad_phase>
void PairFinder<broad_phase>::update_hand(Hand& hand, PartId id)
{
    Bounded<PartId>& bodies = hand.bodies;
    PartId* const place = std::lower_bound(bodies.begin(), bodies.end(), id);
    const bool is_there = place != bodies.end() && *place == id;
    const bool belongs = overlap(hand.box, boxes_.box(id));
    if (is_there == belongs) return;
    if (is_there) {
        std::copy(place + 1, bodies.end(), place);
        bodies.resize(bodies.size() - 1);
    } else {
        bodies.add(id); // there is room for all, so that `place` stays valid
        std::rotate(place, bodies.end() - 1, bodies.end());
    }
}

/// Makes a new box for a hand, around its predicted path, and finds the parts in it.
template <BroadPhase broad_phase>
void PairFinder<broad_phase>::renew_hand(Hand& known, const HandPath& path)
{
    ++hands_renewed_;
    glm::dvec3 ahead = (path.to - path.from) * hand_look_ahead_ticks;
    const glm::dvec3 size = glm::abs(ahead);
    const double length = std::max({size.x, size.y, size.z});
    if (length > hand_stretch_max * path.radius) ahead *= hand_stretch_max * path.radius / length;
    const Aabb along = hull(glm::dvec3{0.0}, ahead);
    const Aabb way = hull(path.from, path.to);
    const Aabb inner = grown({way.low + along.low, way.high + along.high}, glm::dvec3{path.radius});
    known.radius = path.radius;
    known.box = grown(inner, glm::dvec3{path.radius});
    known.middle = inner.centre();
    known.room = 0.5 * inner.size();
    known.bodies.clear();
    boxes_.for_overlapping(known.box, [&](PartId id) { known.bodies.add(id); });
    std::sort(known.bodies.begin(), known.bodies.end());
}

template <BroadPhase broad_phase>
void PairFinder<broad_phase>::on_wake(const Bodies& bodies, BodyId body)
{
    fat_boxes_.update_slot(bodies, bodies.slot_of[body]);
    if (counts().pairs_left_out != 0) has_left_out_ = true; // perhaps a pair of this body
    const auto activate = [this](PairIndex index) { pairs_.set_active(index, true); };
    bodies.for_parts(body, [&](PartId part) {
        pairs_.for_first(part, activate);
        pairs_.for_second(part, activate);
        plane_pairs_.for_first(part,
                               [this](PairIndex index) { plane_pairs_.set_active(index, true); });
    });
}

template <BroadPhase broad_phase>
void PairFinder<broad_phase>::on_sleep(const Bodies& bodies, BodyId body, Slot was_in)
{
    if (was_in < bodies.awake) fat_boxes_.update_slot(bodies, was_in);
    const auto park = [&](PairIndex index, PartId other) {
        if (bodies.slot_of[other] >= bodies.awake) pairs_.set_active(index, false);
    };
    bodies.for_parts(body, [&](PartId part) {
        pairs_.for_first(part, [&](PairIndex index) { park(index, pairs_[index].b); });
        pairs_.for_second(part, [&](PairIndex index) { park(index, pairs_[index].a); });
        plane_pairs_.for_first(part,
                               [this](PairIndex index) { plane_pairs_.set_active(index, false); });
    });
}

template <BroadPhase broad_phase>
void PairFinder<broad_phase>::apply_changes()
{
    pairs_.apply_changes();
    plane_pairs_.apply_changes();
}

template <BroadPhase broad_phase>
void PairFinder<broad_phase>::forget(const Bodies& bodies, BodyId body)
{
    const auto forget_it = [this](PairIndex index) { pairs_[index].memory = {}; };
    bodies.for_parts(body, [&](PartId part) {
        pairs_.for_first(part, forget_it);
        pairs_.for_second(part, forget_it);
        plane_pairs_.for_first(part, [this](PairIndex index) { plane_pairs_[index].memory = {}; });
    });
}

template <BroadPhase broad_phase>
typename PairFinder<broad_phase>::Counts PairFinder<broad_phase>::counts() const
{
    return {renewed_, hands_renewed_, pairs_.left_out() + plane_pairs_.left_out()};
}

template class PairFinder<BroadPhase::all_pairs>;
template class PairFinder<BroadPhase::grid>;

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// The part of continuous collision that finds which two bodies may touch, and when.
#include "scene/rigid/allowed_overlap.hpp"
#include "scene/rigid/continuous.hpp"

#include <algorithm>

namespace hapnet::scene {

namespace {

double shortest_half(const SteadyBox& box)
{
    return std::min(box.half.x, std::min(box.half.y, box.half.z));
}

} // namespace

bool ContinuousCollision::are_to_meet(FlyerIndex a, std::uint32_t b, bool is_plane) const
{
    for (MeetingIndex i = flyers_[a].first; i != none;) {
        const Meeting& meeting = meetings_[i];
        const bool is_a = meeting.a == a;
        if (meeting.is_plane == is_plane && (is_a ? meeting.b : meeting.a) == b) return true;
        i = is_a ? meeting.next_of_a : meeting.next_of_b;
    }
    return false;
}

/// Replaces the box around a body by one of its parts.
void ContinuousCollision::set_part(SteadyBox& flight, const BodyPart& part)
{
    flight.half = part.half;
    flight.radius = part.radius;
    flight.rounding = part.rounding;
    flight.is_part = true;
    flight.arm = part.at;
    flight.frame = part.axes;
}

/// Returns the motion of a part of a flyer. A body of several parts needs `room` for the result.
const SteadyBox& ContinuousCollision::flight_of(const Bodies& bodies, FlyerIndex index, PartId part,
                                                SteadyBox& room) const
{
    const Flyer& flyer = flyers_[index];
    if (!flyer.has_parts) return flyer.flight;
    room = flyer.flight;
    set_part(room, bodies.parts[part]);
    return room;
}

/// Returns the gap of the two bodies at a moment.
Gap ContinuousCollision::gap_of(const Surroundings& around, const Meeting& meeting,
                                double time) const
{
    const Bodies& bodies = around.state.bodies;
    SteadyBox room;
    const OrientedBox box = flight_of(bodies, meeting.a, meeting.part_a, room).at(time);
    if (!meeting.is_plane)
        return gap_between(box, flight_of(bodies, meeting.b, meeting.part_b, room).at(time));
    const PlaneDescription& plane = around.config.planes[meeting.b];
    return gap_between(PlaneSurface{plane.normal, plane.offset_m}, box);
}

void ContinuousCollision::add_meeting(const Surroundings& around, const Meeting& wanted)
{
    if (meetings_.is_full()) {
        Flyer& stopped = flyers_[flyers_[wanted.a].is_movable ? wanted.a : wanted.b];
        if (!stopped.has_stopped) stop(stopped, wanted.time);
        ++around.state.interventions.budgets_spent;
        return;
    }
    const Bodies& bodies = around.state.bodies;
    SteadyBox room_a, room_b;
    const SteadyBox& flight = flight_of(bodies, wanted.a, wanted.part_a, room_a);
    bool is_round = flight.is_round();
    double smallest = shortest_half(flight);
    if (!wanted.is_plane) {
        const SteadyBox& other = flight_of(bodies, wanted.b, wanted.part_b, room_b);
        is_round = is_round || other.is_round();
        smallest =
            is_round ? flight.rounding + other.rounding : std::min(smallest, shortest_half(other));
    }
    const Gap gap = gap_of(around, wanted, 0.0);
    // Bodies that overlap far at the start cannot pass each other any more. A round body can until
    // its core overlaps the other body.
    if (gap.distance <= -(is_round ? round_overlap_max : overlap_max) * smallest) return;
    const auto index = static_cast<MeetingIndex>(meetings_.size());
    Meeting& meeting = meetings_.add();
    meeting = wanted;
    meeting.smallest = smallest;
    meeting.gap = std::min(gap.distance, 0.0);
    meeting.gap -= next_overlap(meeting.gap, smallest);
    meeting.next_of_a = flyers_[meeting.a].first;
    flyers_[meeting.a].first = index;
    if (!meeting.is_plane) {
        meeting.next_of_b = flyers_[meeting.b].first;
        flyers_[meeting.b].first = index;
    }
    advance(around, meeting, wanted.time, steps_at_once);
}

/// Returns the next touch; of those at the same time the first.
ContinuousCollision::MeetingIndex ContinuousCollision::earliest() const
{
    MeetingIndex found = none;
    for (MeetingIndex i = 0; i < meetings_.size(); ++i) {
        const Meeting& meeting = meetings_[i];
        if (meeting.is_over) continue;
        if (found == none || meeting.time < meetings_[found].time) found = i;
    }
    return found;
}

/// Searches for the next touch of two bodies that keep their motion, with a limited number of
/// looks.
void ContinuousCollision::advance(const Surroundings& around, Meeting& meeting, double from,
                                  std::uint32_t looks_max)
{
    const Flyer& a = flyers_[meeting.a];
    const auto stays = [](const Flyer& flyer) { return flyer.has_stopped || !flyer.is_movable; };
    meeting.is_sure = false;
    meeting.is_over = stays(a) && (meeting.is_plane || stays(flyers_[meeting.b]));
    if (!meeting.is_plane && a.cluster != none && a.cluster == flyers_[meeting.b].cluster)
        meeting.is_over = true;
    if (meeting.is_over) return;
    GapSearch asked{.gap = meeting.gap,
                    .near = near_share * next_overlap(meeting.gap, meeting.smallest),
                    .from = from,
                    .to = a.is_released ? scales_.tick : std::min(scales_.tick, a.bend)};
    const std::uint32_t granted = std::min(looks_max, steps_left_);
    std::uint32_t left = granted;
    Advanced advanced;
    const Bodies& bodies = around.state.bodies;
    SteadyBox room_a, room_b;
    const SteadyBox& flight = flight_of(bodies, meeting.a, meeting.part_a, room_a);
    if (meeting.is_plane) {
        const PlaneDescription& plane = around.config.planes[meeting.b];
        advanced = advance_to_gap(PlaneSurface{plane.normal, plane.offset_m}, flight, asked, left);
    } else {
        const Flyer& b = flyers_[meeting.b];
        if (!b.is_released) asked.to = std::min(asked.to, b.bend);
        advanced = advance_to_gap(flight, flight_of(bodies, meeting.b, meeting.part_b, room_b),
                                  asked, left);
    }
    steps_left_ -= granted - left;
    meeting.time = advanced.time;
    meeting.is_sure = advanced.end == Advanced::End::reached;
    meeting.is_over = advanced.end == Advanced::End::clear;
}

/// Calls advance() for all of a flyer's meetings, except those with another that is `done`.
void ContinuousCollision::advance_all(const Surroundings& around, FlyerIndex index, double from,
                                      FlyerIndex done)
{
    for_meetings_of(index, [&](Meeting& meeting) {
        const FlyerIndex other = meeting.a == index ? meeting.b : meeting.a;
        if (meeting.is_plane || other != done) advance(around, meeting, from, steps_at_once);
    });
}

/// Notes that a body was pushed. A sleeper will be woken.
void ContinuousCollision::note_push(const Bodies& bodies, BodyId body)
{
    if (bodies.slot_of[body] < bodies.awake) return;
    if (std::find(woken_.begin(), woken_.end(), body) == woken_.end()) woken_.add(body);
}

} // namespace hapnet::scene

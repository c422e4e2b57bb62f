// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/side.hpp"

#include <algorithm>
#include <cstddef>

namespace hapnet::peer {

namespace {

/// Calls copy(of_row, of_sample) for each field of a sample that a row keeps.
template <typename Copy>
void for_each_kept_field(const Copy& copy)
{
    using device::Sample;
    using record::TickRow;
    copy(&TickRow::hip, &Sample::hip);
    copy(&TickRow::hip_velocity, &Sample::velocity);
    copy(&TickRow::gripping, &Sample::gripping);
    copy(&TickRow::docked, &Sample::docked);
    copy(&TickRow::calibrated, &Sample::calibrated);
    copy(&TickRow::fault, &Sample::fault);
    copy(&TickRow::buttons, &Sample::buttons);
    copy(&TickRow::presses, &Sample::presses);
    copy(&TickRow::sample_sequence, &Sample::sequence);
}

} // namespace

device::Cue Side::take_cue()
{
    const Session& session = *peer_.session();
    cued_ = session.start;
    return {session.start,   peer_.hands_on(),      base::Seed{session.seed}, id_,
            peer_.is_left(), peer_.share_of_side(), peer_.rank() < 2};
}

record::TickRow Side::row(std::uint64_t number, const TickTime& time) const
{
    const Tick& now = tick();
    record::TickRow row;
    row.tick = number;
    row.due = time.due;
    row.late = time.late;
    row.missed_before = time.missed_before;
    row.sent_sequence = now.sequence;
    row.phase = now.phase;
    row.touching = now.touched.touching;
    row.remote_touching = now.remote_touching;
    row.remote_fresh = now.freshness > 0.0;
    row.cube = peer_.position();
    row.cube_velocity = peer_.velocity();
    row.contact = now.force;
    row.device = told_;
    row.remote = now.remote_force;
    for_each_kept_field([&]<typename Kept, typename Value>(Kept record::TickRow::*of_row,
                                                           Value device::Sample::*of_sample) {
        row.*of_row = static_cast<Kept>(sample_.*of_sample);
    });
    row.governor = static_cast<std::uint8_t>(governor_state_);
    return row;
}

record::BodyRow Side::body_row(std::uint64_t number, const SharedBody& body) const
{
    const scene::BodyState state = peer_.world().body(body.id);
    const auto shared = peer_.shared();
    const auto index = std::ranges::find(shared, body.id, &SharedBody::id) - shared.begin();
    return {.tick = number,
            .body = static_cast<std::uint16_t>(body.id),
            .position = state.position,
            .velocity = state.velocity,
            .orientation = state.orientation,
            .angular_velocity = {state.angular_velocity},
            .owner = peer_.owner(static_cast<std::size_t>(index))};
}

device::Sample sample_of(const record::TickRow& row)
{
    device::Sample sample;
    for_each_kept_field([&]<typename Kept, typename Value>(Kept record::TickRow::*of_row,
                                                           Value device::Sample::*of_sample) {
        sample.*of_sample = static_cast<Value>(row.*of_row);
    });
    return sample;
}

} // namespace hapnet::peer

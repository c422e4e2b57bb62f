// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/side.hpp"

namespace hapnet::peer {

device::Cue Side::take_cue()
{
    const Session& session = *peer_.session();
    cued_ = session.start;
    return {session.start, peer_.hands_on(), base::Seed{session.seed}, id_, session.is_left};
}

record::TickRow Side::row(std::uint64_t number, const TickTime& time) const
{
    record::TickRow row;
    row.tick = number;
    row.due = time.due;
    row.late = time.late;
    row.missed_before = time.missed_before;
    row.sent_sequence = tick_.sequence;
    row.phase = tick_.phase;
    row.touching = tick_.touched.touching;
    row.remote_touching = tick_.remote_touching;
    row.remote_fresh = tick_.freshness > 0.0;
    row.hip = sample_.hip;
    row.hip_velocity = sample_.velocity;
    row.cube = peer_.position();
    row.cube_velocity = peer_.velocity();
    row.contact = tick_.force;
    row.device = told_;
    row.remote = tick_.remote_force;
    row.gripping = sample_.gripping;
    row.docked = sample_.docked;
    row.calibrated = sample_.calibrated;
    row.buttons = sample_.buttons;
    row.fault = static_cast<std::uint8_t>(sample_.fault);
    row.presses = sample_.presses;
    row.sample_sequence = static_cast<std::uint16_t>(sample_.sequence);
    row.governor = static_cast<std::uint8_t>(governor_state_);
    return row;
}

device::Sample sample_of(const record::TickRow& row)
{
    device::Sample sample;
    sample.hip = row.hip;
    sample.velocity = row.hip_velocity;
    sample.gripping = row.gripping;
    sample.docked = row.docked;
    sample.calibrated = row.calibrated;
    sample.fault = static_cast<device::Fault>(row.fault);
    sample.buttons = row.buttons;
    sample.presses = row.presses;
    sample.sequence = row.sample_sequence;
    return sample;
}

} // namespace hapnet::peer

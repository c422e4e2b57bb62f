// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/servo.hpp"

#include "peer/loop/watched_turn.hpp"
#include "peer/loop/zero_force.hpp"
#include "proto/net/clock.hpp"

#include <algorithm>

namespace hapnet::peer {

namespace {

constexpr int servo_priority = 45;    // above the emulator's, below the kernel's own threads
constexpr int receive_rounds_max = 8; // of up to 64 datagrams
constexpr base::Duration session_noted_every{std::chrono::seconds{1}};

record::Phase phase_of(Phase phase, bool alone)
{
    switch (phase) {
    case Phase::waiting: return record::Phase::waiting;
    case Phase::countdown: return record::Phase::countdown;
    case Phase::running: return alone ? record::Phase::alone : record::Phase::running;
    case Phase::hands_off: return alone ? record::Phase::alone : record::Phase::hands_off;
    case Phase::ended: return record::Phase::ended;
    }
    return record::Phase::ended;
}

} // namespace

Servo::Servo(const Parts& parts) : parts_{parts}, reporter_{ways_back_of(parts.rig.device())} {}

void Servo::run()
{
    const net::CrashStack stack;
    {
        const ZeroForceAtTheEnd zero{parts_.rig.device(), parts_.watchdog};
        real_time_ = net::request_real_time(servo_priority);
        follow_device();
        go_at_own_pace();
    }
    done_.store(true, std::memory_order_release);
}

bool Servo::goes_on() const { return !parts_.peer.finished() && !parts_.watchdog.is_dying(); }

void Servo::follow_device()
{
    device::Device& device = parts_.rig.device();
    if (device.capabilities().pacing != device::Pacing::device) return;
    DeviceRhythm rhythm{parts_.tick};
    device.pace([this, &rhythm] { return cycle(rhythm); });
    if (goes_on()) tell_governor_of_silence();
}

/// The device's own silence ended its rhythm. Else the governor would find that this loop stood
/// still, and a person be told the wrong thing.
void Servo::tell_governor_of_silence()
{
    device::Governor& governor = parts_.rig.governor();
    const auto state = governor.state();
    const bool pushes =
        state == device::GovernorState::ramping || state == device::GovernorState::active;
    if (pushes) governor.latch({device::Fault::timeout, device::Trip::silence});
}

/// One of the device's; whether another is wanted.
bool Servo::cycle(DeviceRhythm& rhythm)
{
    const base::TimePoint now = net::monotonic_now();
    parts_.watchdog.beat(now);
    if (const auto beat = rhythm.at(now)) take_turn(*beat, now);
    return goes_on();
}

void Servo::go_at_own_pace()
{
    OwnRhythm rhythm{net::monotonic_now(), parts_.tick};
    while (goes_on()) {
        net::sleep_until(rhythm.next());
        const base::TimePoint now = net::monotonic_now();
        parts_.watchdog.beat(now);
        take_turn(rhythm.begin(now), now);
        rhythm.end(net::monotonic_now());
    }
}

void Servo::take_turn(const Beat& beat, base::TimePoint now)
{
    record::TickRow row;
    row.tick = counters_.ticks++;
    row.due = beat.due;
    row.late = beat.late;
    row.missed_before = beat.missed_before;
    counters_.late.add(row.late);
    counters_.missed += beat.missed_before;
    if (stop_.load(std::memory_order_relaxed)) parts_.peer.leave(wire::ByeReason::interrupted);
    turn(row, now);
    parts_.journal.put(row);
    phase_ = row.phase;
    is_remote_heard_ = row.remote_fresh;
    force_ = row.device;
    if (!first_turn_) first_turn_ = now;
    last_turn_ = now;
    standing_.give_if_asked([this](Standing& standing) { describe(standing); });
    running_.store(true, std::memory_order_release);
}

void Servo::turn(record::TickRow& row, base::TimePoint now)
{
    Peer& peer = parts_.peer;
    WatchedTurn watched{parts_.rig, parts_.watchdog};
    receive(row.tick);
    if (parts_.watchdog.take_fault()) {
        parts_.rig.governor().latch({device::Fault::timeout, device::Trip::loop});
    }
    const device::Sample& sample = parts_.rig.read(now);
    const Tick tick =
        peer.tick(now, {sample.hip, sample.velocity, sample.gripping, is_in_hand(sample)});
    const base::Force force = watched.apply(tick.force, tick.permitted, now);
    send();
    while (const auto event = peer.event()) parts_.journal.put(Happening{*event, now});
    tell_of_device(now);
    note_session(now);

    row.sent_sequence = tick.sequence;
    row.phase = phase_of(tick.phase, peer.is_alone());
    row.touching = tick.touched.touching;
    row.remote_touching = tick.remote_touching;
    row.remote_fresh = tick.freshness > 0.0;
    row.hip = sample.hip;
    row.hip_velocity = sample.velocity;
    const scene::BodyState body = peer.body();
    row.cube = body.position;
    row.cube_velocity = body.velocity;
    row.contact = tick.force;
    row.device = force;
    row.remote = tick.remote_force;
    row.gripping = sample.gripping;
    row.docked = sample.docked;
    row.calibrated = sample.calibrated;
    row.buttons = sample.buttons;
    row.fault = static_cast<std::uint8_t>(sample.fault);
    row.presses = sample.presses;
    row.sample_sequence = static_cast<std::uint16_t>(sample.sequence);
    row.governor = static_cast<std::uint8_t>(parts_.rig.governor().state());
}

Standing Servo::standing() const
{
    Standing standing;
    describe(standing);
    return standing;
}

void Servo::describe(Standing& standing) const
{
    const device::Governor& governor = parts_.rig.governor();
    standing.at = last_turn_;
    standing.elapsed = last_turn_ - first_turn_.value_or(last_turn_);
    standing.phase = phase_;
    standing.is_remote_heard = is_remote_heard_;
    standing.force = force_;
    standing.loop = counters_;
    standing.messages = parts_.peer.counters();
    standing.session = parts_.peer.session();
    standing.clock = parts_.peer.clock();
    standing.refusal = parts_.peer.refusal();
    standing.calibration = parts_.rig.calibration();
    standing.governor_state = governor.state();
    standing.fault = governor.fault();
    standing.governor = governor.counters();
    standing.force_limit_n = governor.limits().force_max_n;
    standing.motor_heat = governor.heat();
    standing.device = parts_.rig.counters();
    standing.watchdog_halts = parts_.watchdog.halts();
    standing.overflowed = parts_.socket.overflowed();
    standing.real_time = real_time_;
}

void Servo::tell_of_device(base::TimePoint now)
{
    const device::Rig& rig = parts_.rig;
    const auto news = reporter_.look(rig.calibration(), rig.governor().fault(), now);
    if (news) parts_.journal.put(DeviceHappening{*news, now});
}

void Servo::receive(std::uint64_t tick)
{
    // Bounded: a flood must not keep the loop from its device.
    for (int round = 0; round < receive_rounds_max; ++round) {
        const auto batch = parts_.socket.receive();
        for (const net::Received& received : batch) {
            if (!(received.from == parts_.remote)) {
                ++counters_.strangers;
                continue;
            }
            parts_.peer.on_datagram(received.bytes, received.at);
            if (received.bytes.size() > record::MessageRow::bytes_max) continue;
            record::MessageRow row{.tick = tick,
                                   .received_at = received.at,
                                   .size = static_cast<std::uint16_t>(received.bytes.size())};
            std::copy(received.bytes.begin(), received.bytes.end(), row.bytes.begin());
            parts_.journal.put(row);
        }
        if (batch.size() < net::UdpSocket::batch_max) return;
    }
}

void Servo::send()
{
    while (const auto datagram = parts_.peer.poll()) {
        const auto outcome = parts_.socket.send(parts_.remote, datagram->bytes());
        if (outcome != net::SendOutcome::sent) ++counters_.send_failures;
    }
}

void Servo::note_session(base::TimePoint now)
{
    const auto& session = parts_.peer.session();
    if (!session) return;
    if (cued_ != session->start) {
        cued_ = session->start;
        parts_.rig.device().on_cue({session->start, parts_.peer.hands_on(),
                                    base::Seed{session->seed}, parts_.id, session->is_left});
    }
    // A side that was restarted has a clock unknown to us until it has answered.
    const auto clock = parts_.peer.clock();
    if (!clock) return;
    const bool is_new =
        !noted_ || noted_->session != session->number || noted_->start != session->start;
    if (!is_new && now - *noted_at_ < session_noted_every) return;
    noted_ = record::SessionRow{.start = session->start,
                                .length = parts_.peer.length(),
                                .remote_offset = clock->offset,
                                .offset_uncertainty = clock->uncertainty,
                                .session = session->number,
                                .seed = session->seed};
    noted_at_ = now;
    parts_.journal.put(*noted_);
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/loop/servo.hpp"

#include "peer/loop/watched_rig.hpp"
#include "peer/loop/zero_force.hpp"
#include "proto/base/ensure.hpp"
#include "proto/net/clock.hpp"

#include <algorithm>

namespace hapnet::peer::loop {

namespace {

constexpr int servo_priority = 45;    // above the emulator's, below the kernel's own threads
constexpr int receive_rounds_max = 8; // per tick, of up to 64 datagrams each

OtherStatus describe_other(const Remote& other, const line::Line& line, base::TimePoint now)
{
    const ClockSync& clock = other.handshake().clock_sync();
    return {.id = other.id(),
            .clock = clock.estimate(),
            .is_clock_in_doubt = clock.is_in_doubt(),
            .clock_jumps = clock.jumps(),
            .paths = other.paths(),
            .session = other.session() ? other.session()->number : 0,
            .is_heard = other.freshness_at(now) > 0.0,
            .is_gone = other.is_gone(),
            .line = line::status_of(line, now)};
}

} // namespace

Servo::Servo(const Parts& parts)
    : parts_{parts}, reporter_{monitor::recovery_of(parts.rig.device())}
{
    base::ensure(parts.lines.size() == parts.side.peer().others().size() &&
                 parts.remotes.size() == parts.lines.size());
    for (const net::Endpoint& remote : parts.remotes) places_.push_back(remote.packed());
}

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

bool Servo::goes_on() const
{
    return !parts_.side.peer().finished() && !parts_.watchdog.is_dying();
}

void Servo::follow_device()
{
    device::Device& device = parts_.rig.device();
    if (device.capabilities().pacing != device::Pacing::device) return;
    DeviceTimer timer{parts_.tick};
    device.pace([this, &timer] { return on_device_cycle(timer); });
    if (goes_on()) tell_governor_of_silence();
}

/// Informs the governor that the device fell silent and so ended its pace. Otherwise the governor
/// would conclude that the loop stood still, and report the wrong cause.
void Servo::tell_governor_of_silence()
{
    device::Governor& governor = parts_.rig.governor();
    const auto state = governor.state();
    const bool pushes =
        state == device::GovernorState::ramping || state == device::GovernorState::active;
    if (pushes) governor.latch({device::Fault::timeout, device::Trip::silence});
}

/// Handles one cycle of the device. Returns true if the device is to continue.
bool Servo::on_device_cycle(DeviceTimer& timer)
{
    const base::TimePoint now = net::monotonic_now();
    parts_.watchdog.beat(now);
    if (const auto time = timer.at(now)) tick(*time, now);
    return goes_on();
}

void Servo::go_at_own_pace()
{
    FixedRateTimer timer{net::monotonic_now(), parts_.tick};
    while (goes_on()) {
        net::sleep_until(timer.next());
        const base::TimePoint now = net::monotonic_now();
        parts_.watchdog.beat(now);
        tick(timer.begin(now), now);
        timer.end(net::monotonic_now());
    }
}

void Servo::tick(const TickTime& time, base::TimePoint now)
{
    counters_.late.add(time.late);
    counters_.missed += time.missed_before;
    if (parts_.gate.is_stopping()) parts_.side.peer().leave(wire::ByeReason::interrupted);
    play(now);
    note_tick(time);
    ++counters_.ticks;
    if (!first_tick_) first_tick_ = now;
    last_tick_ = now;
    status_slot_.fill_if_requested([this](ServoStatus& status) { describe(status); });
    running_.store(true, std::memory_order_release);
}

void Servo::note_tick(const TickTime& time)
{
    parts_.journal.put(parts_.side.row(counters_.ticks, time));
    if (!parts_.layout.has_bodies()) return;
    for (const SharedBody& body : parts_.side.peer().shared())
        parts_.journal.put(parts_.side.body_row(counters_.ticks, body));
}

void Servo::play(base::TimePoint now)
{
    WatchedRig rig{parts_.rig, parts_.watchdog, &parts_.gate};
    receive(now);
    if (parts_.watchdog.take_fault()) {
        parts_.rig.governor().latch({device::Fault::timeout, device::Trip::loop});
    }
    parts_.side.step(now, rig);
    withheld_ = rig.withheld();
    if (withheld_ != Withheld::no) ++counters_.withheld;
    tend_lines(now);
    send(now);
    while (const auto notice = parts_.side.notice())
        parts_.journal.put(TimedEvent{notice->event, now, notice->about});
    report_device(now);
    notes_.after_tick(parts_.side.peer(), now,
                      [this](const record::SessionRow& row) { parts_.journal.put(row); });
}

ServoStatus Servo::status() const
{
    ServoStatus status;
    describe(status);
    return status;
}

void Servo::describe(ServoStatus& status) const
{
    const Peer& peer = parts_.side.peer();
    const device::Governor& governor = parts_.rig.governor();
    status.at = last_tick_;
    status.elapsed = last_tick_ - first_tick_.value_or(last_tick_);
    status.phase = parts_.side.tick().phase;
    status.is_remote_heard = parts_.side.tick().freshness > 0.0;
    status.force = parts_.side.told();
    status.loop = counters_;
    status.messages = peer.counters();
    status.session = peer.session();
    status.is_left = peer.is_left();
    status.others_count = peer.others().size();
    for (std::size_t i = 0; i < status.others_count; ++i)
        status.others.at(i) = describe_other(peer.others()[i], parts_.lines[i], last_tick_);
    status.refusal = peer.refusal();
    status.calibration = parts_.rig.calibration();
    status.governor_state = governor.state();
    status.withheld = withheld_;
    status.fault = governor.fault();
    status.governor = governor.counters();
    status.force_limit_n = governor.limits().force_max_n;
    status.motor_heat = governor.heat();
    status.energy_limits = governor.limits().energy;
    if (const device::EnergyFigures* energy = governor.energy()) status.energy = *energy;
    status.device = parts_.rig.counters();
    status.watchdog_halts = parts_.watchdog.halts();
    status.overflowed = parts_.socket.overflowed();
    status.real_time = real_time_;
}

void Servo::report_device(base::TimePoint now)
{
    const device::Rig& rig = parts_.rig;
    const device::Governor& governor = rig.governor();
    if (const auto news = reporter_.look(rig.calibration(), governor.fault(), now))
        parts_.journal.put(TimedDeviceNews{*news, now});
    if (const auto news = reporter_.look_at_energy(governor.counters().energy_limited, now))
        parts_.journal.put(TimedDeviceNews{*news, now});
}

void Servo::receive(base::TimePoint now)
{
    // The number of rounds is limited, because a flood must not keep the loop from its device.
    for (int round = 0; round < receive_rounds_max; ++round) {
        const auto batch = parts_.socket.receive();
        for (const net::Received& received : batch) {
            const auto opened = parts_.lines.open(received.bytes, received.from.packed(), now);
            if (opened) hear(*opened, received.at);
        }
        if (batch.size() < net::UdpSocket::batch_max) return;
    }
}

/// Handles a message from the line. The record gets it in plain form.
void Servo::hear(const line::Lines::Opened& opened, base::TimePoint at)
{
    if (!is_worth_a_row(opened, at)) {
        ++counters_.unrecorded;
        return;
    }
    const std::span<const std::byte> message = opened.message;
    if (message.size() > parts_.layout.message_bytes_max()) {
        ++counters_.too_long;
        return;
    }
    parts_.journal.put(HeardMessage{.tick = counters_.ticks,
                                    .received_at = at,
                                    .from = parts_.side.peer().others()[opened.from].id(),
                                    .message = line::Datagram{message}});
}

/// Passes a message to the session, and returns true if it is to be recorded. Messages that had an
/// effect always are. Others, such as duplicates, are recorded only up to a rate, because a flood
/// would fill the disk.
bool Servo::is_worth_a_row(const line::Lines::Opened& opened, base::TimePoint at)
{
    const std::uint64_t states_before = parts_.side.peer().counters().states;
    parts_.side.on_datagram(opened.message, at, opened.from);
    if (parts_.side.peer().counters().states != states_before) return true;
    return without_effect_.admits(at);
}

/// Advances keys and reports news of the lines. Call it after the force was applied, because a
/// handshake may take a multiplication on the curve.
void Servo::tend_lines(base::TimePoint now)
{
    if (parts_.lines.are_sealed()) parts_.lines.tick({now, net::wall_clock_nanoseconds()});
    for (std::size_t i = 0; i < parts_.lines.size(); ++i) {
        while (const auto news = parts_.lines[i].news())
            parts_.journal.put(TimedLineNews{*news, now, parts_.side.peer().others()[i].id()});
    }
}

void Servo::send(base::TimePoint now)
{
    for (std::size_t i = 0; i < parts_.lines.size(); ++i) {
        parts_.lines[i].send_all([this, i] { return parts_.side.poll(i); },
                                 [this, i](std::span<const std::byte> bytes,
                                           const secure::Place& to) { send_to(i, bytes, to); },
                                 now);
    }
}

void Servo::send_to(std::size_t other, std::span<const std::byte> bytes, const secure::Place& to)
{
    net::Endpoint& remote = parts_.remotes[other];
    if (to != places_[other]) {
        remote = remote.unpacked(to);
        places_[other] = to;
    }
    const auto outcome = parts_.socket.send(remote, bytes);
    if (outcome != net::SendOutcome::sent) ++counters_.send_failures;
    counters_.last_send = outcome;
    sending_.store(outcome, std::memory_order_relaxed);
}

} // namespace hapnet::peer::loop

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/servo.hpp"

#include "proto/net/clock.hpp"

#include <algorithm>

namespace hapnet::peer {

namespace {

constexpr int servo_priority = 45; // above the emulator's, below the kernel's own threads
constexpr int zero_force_repeats = 3;
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

/// Zero force on every way out of a scope, repeated because a wire may lose one.
class ZeroForceAtTheEnd {
public:
    explicit ZeroForceAtTheEnd(device::Device& device) : device_{device} {}
    ~ZeroForceAtTheEnd()
    {
        for (int i = 0; i < zero_force_repeats; ++i) device_.apply({});
    }
    ZeroForceAtTheEnd(const ZeroForceAtTheEnd&) = delete;
    ZeroForceAtTheEnd& operator=(const ZeroForceAtTheEnd&) = delete;

private:
    device::Device& device_;
};

} // namespace

Servo::Servo(const Parts& parts) : parts_{parts} {}

void Servo::run()
{
    {
        const ZeroForceAtTheEnd zero{parts_.rig.device()};
        real_time_ = net::request_real_time(servo_priority);
        loop();
    }
    done_.store(true, std::memory_order_release);
}

void Servo::loop()
{
    base::TimePoint due = net::monotonic_now() + parts_.tick;
    std::uint32_t missed_before = 0;
    while (!parts_.peer.finished()) {
        net::sleep_until(due);
        const base::TimePoint now = net::monotonic_now();
        record::TickRow row;
        row.tick = counters_.ticks++;
        row.due = due;
        row.late = now - due;
        row.missed_before = missed_before;
        counters_.late.add(row.late);
        if (stop_.load(std::memory_order_relaxed)) parts_.peer.leave(wire::ByeReason::interrupted);
        turn(row, now);
        parts_.journal.put(row);
        running_.store(true, std::memory_order_release);

        due += parts_.tick;
        missed_before = 0;
        if (const base::TimePoint after = net::monotonic_now(); after >= due + parts_.tick) {
            const auto behind = (after - due) / parts_.tick;
            missed_before = static_cast<std::uint32_t>(behind);
            counters_.missed += missed_before;
            due += behind * parts_.tick;
        }
    }
}

void Servo::turn(record::TickRow& row, base::TimePoint now)
{
    Peer& peer = parts_.peer;
    receive(row.tick);
    const device::Sample& sample = parts_.rig.read(now);
    const Tick tick = peer.tick(now, {sample.hip, sample.velocity, sample.gripping});
    const base::Force force = parts_.rig.apply(tick.force, tick.permitted, now);
    send();
    while (const auto event = peer.event()) parts_.journal.put(Happening{*event, now});
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
    row.sample_sequence = static_cast<std::uint32_t>(sample.sequence);
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

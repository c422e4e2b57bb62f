// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "peer/core/session_notes.hpp"
#include "peer/core/side.hpp"
#include "peer/line/lines.hpp"
#include "peer/loop/force_gate.hpp"
#include "peer/loop/journal.hpp"
#include "peer/loop/servo_status.hpp"
#include "peer/loop/snapshot_slot.hpp"
#include "peer/loop/watchdog.hpp"
#include "peer/monitor/device_news.hpp"
#include "peer/monitor/rate_limit.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/record/codec.hpp"

#include <atomic>
#include <vector>

namespace hapnet::peer::loop {

/// The 1 kHz loop. Each tick receives datagrams, steps its Side, sends datagrams and writes the
/// journal, in this order. It runs at a fixed rate and wakes at absolute times. A device that sets
/// the pace calls the loop instead, on a thread of the device's choice. If that device falls
/// silent, the loop continues at the fixed rate. A tick that is a whole period late skips the
/// missed ticks and counts them. In the tick after a stop was requested, the force is zero,
/// whatever the other threads are doing. However run() ends, the device has then been sent zero
/// force three times.
class Servo {
public:
    /// Everything that a servo works with. All parts must outlive it.
    struct Parts {
        Side& side;
        device::Rig& rig;
        net::UdpSocket& socket;
        std::vector<net::Endpoint> remotes; // places of the other peers at the start
        line::Lines& lines;
        Journal& journal;
        Watchdog& watchdog;
        ForceGate& gate;
        base::Duration tick{std::chrono::milliseconds{1}};
        /// The kinds of rows in the record, and their lengths.
        record::Layout layout{};
    };

    explicit Servo(const Parts& parts);

    /// Runs until the session has ended, or until the goodbyes after a stop are sent.
    void run();

    /// True once the loop has run its first tick. Call it from another thread.
    [[nodiscard]] bool is_running() const { return running_.load(std::memory_order_acquire); }
    /// True once run() has returned. Call it from another thread.
    [[nodiscard]] bool is_done() const { return done_.load(std::memory_order_acquire); }

    /// Returns the time of the loop's last sign of life. Call it from another thread.
    [[nodiscard]] base::TimePoint last_beat() const { return parts_.watchdog.last_beat(); }

    /// Returns the outcome of sending the newest datagram. Call it from another thread.
    [[nodiscard]] net::SendOutcome sending() const
    {
        return sending_.load(std::memory_order_relaxed);
    }

    /// Requests the status after the next tick. The function below takes it. Only one other thread
    /// may call them.
    void request_status() { status_slot_.request(); }
    [[nodiscard]] bool take_status(ServoStatus& into) { return status_slot_.take(into); }

    /// Returns the real-time rights that were granted. Call it from another thread, once
    /// is_running().
    [[nodiscard]] net::RealTime real_time() const { return real_time_; }
    /// Returns the status at the end. Call it after run().
    [[nodiscard]] ServoStatus status() const;

private:
    void follow_device();
    void tell_governor_of_silence();
    void go_at_own_pace();
    [[nodiscard]] bool goes_on() const;
    [[nodiscard]] bool on_device_cycle(DeviceTimer& timer);
    void tick(const TickTime& time, base::TimePoint now);
    void note_tick(const TickTime& time);
    void play(base::TimePoint now);
    void report_device(base::TimePoint now);
    void receive(base::TimePoint now);
    void hear(const line::Lines::Opened& opened, base::TimePoint at);
    [[nodiscard]] bool is_worth_a_row(const line::Lines::Opened& opened, base::TimePoint at);
    void tend_lines(base::TimePoint now);
    void send(base::TimePoint now);
    void send_to(std::size_t other, std::span<const std::byte> bytes, const secure::Place& to);
    void describe(ServoStatus& status) const;

    Parts parts_;
    std::vector<secure::Place> places_; // parts_.remotes in packed form
    monitor::DeviceReporter reporter_;
    LoopCounters counters_;
    std::optional<base::TimePoint> first_tick_;
    base::TimePoint last_tick_;
    SnapshotSlot<ServoStatus> status_slot_;
    net::RealTime real_time_;
    /// Admits 2000 a second, and a second of them at once. A real path can duplicate at most all
    /// messages.
    monitor::RateLimit without_effect_{2000, std::chrono::microseconds{500}};
    SessionNotes notes_;
    Withheld withheld_ = Withheld::no; // why force was withheld in the last tick
    std::atomic<net::SendOutcome> sending_{net::SendOutcome::sent};
    std::atomic<bool> running_{false};
    std::atomic<bool> done_{false};
};

} // namespace hapnet::peer::loop

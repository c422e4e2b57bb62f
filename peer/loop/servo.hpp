// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "peer/core/side.hpp"
#include "peer/loop/handover.hpp"
#include "peer/loop/journal.hpp"
#include "peer/loop/standing.hpp"
#include "peer/loop/watchdog.hpp"
#include "proto/net/real_time.hpp"
#include "proto/net/udp_socket.hpp"

#include <atomic>

namespace hapnet::peer {

/// The 1 kHz loop: device, scene, governor, device, network, in this order. It goes at its own
/// pace, waking by absolute time; or, where a device sets the rhythm, at that one's, on the thread
/// that the device calls it from, and at its own pace again when the device falls silent. A tick
/// that comes later than a whole period skips the ones it has missed and counts them. After run()
/// the device has been told zero force three times, whatever ended it.
class Servo {
public:
    /// All that a servo works with; outlives it.
    struct Parts {
        Side& side;
        device::Rig& rig;
        net::UdpSocket& socket;
        net::Endpoint remote;
        Journal& journal;
        Watchdog& watchdog;
        base::Duration tick{std::chrono::milliseconds{1}};
    };

    explicit Servo(const Parts& parts);

    /// Runs until the session has ended, or until the goodbye after stop() is said.
    void run();

    /// From another thread: leave the session and end.
    void stop() { stop_.store(true, std::memory_order_relaxed); }
    /// From another thread: whether the loop has run its first tick.
    [[nodiscard]] bool is_running() const { return running_.load(std::memory_order_acquire); }
    /// From another thread: whether run() has returned.
    [[nodiscard]] bool is_done() const { return done_.load(std::memory_order_acquire); }

    /// From one other thread: asks how it stands after its next tick, and takes what came of that.
    void ask_standing() { standing_.ask(); }
    [[nodiscard]] bool take_standing(Standing& into) { return standing_.take(into); }

    /// From another thread: what was granted, once is_running().
    [[nodiscard]] net::RealTime real_time() const { return real_time_; }
    /// After run(): how it stands in the end.
    [[nodiscard]] Standing standing() const;

private:
    void follow_device();
    void tell_governor_of_silence();
    void go_at_own_pace();
    [[nodiscard]] bool goes_on() const;
    [[nodiscard]] bool on_device_cycle(DeviceTimer& timer);
    void tick(const TickTime& time, base::TimePoint now);
    void play(base::TimePoint now);
    void tell_of_device(base::TimePoint now);
    void receive();
    void send();
    void note_session(base::TimePoint now);
    void describe(Standing& standing) const;

    Parts parts_;
    DeviceReporter reporter_;
    LoopCounters counters_;
    std::optional<base::TimePoint> first_tick_;
    base::TimePoint last_tick_;
    Handover<Standing> standing_;
    net::RealTime real_time_;
    std::optional<record::SessionRow> noted_;
    std::optional<base::TimePoint> noted_at_;
    std::atomic<bool> stop_{false};
    std::atomic<bool> running_{false};
    std::atomic<bool> done_{false};
};

} // namespace hapnet::peer

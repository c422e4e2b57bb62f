// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "proto/net/crash_signal.hpp"

#include <atomic>
#include <cstdint>
#include <thread>

namespace hapnet::peer::loop {

/// The action after a silence of the loop.
enum class Alarm : std::uint8_t {
    none,
    halt,  // silent for longer than any tick takes: zero force
    fault, // silent for longer than the governor tolerates: a fault, too
};
[[nodiscard]] Alarm alarm_after(base::Duration silence);

/// Watches a loop from a thread of its own and halts the device in the loop's stead: when no beat
/// came for 20 ms, and when the program dies. Sleeps until a beat is overdue. Its real-time
/// priority is above the loop's, if the system grants it.
class Watchdog {
public:
    /// Both outlive it. With a null `crash` it does not act when the program dies.
    explicit Watchdog(device::Device& device, const net::CrashSignal* crash = nullptr);
    /// Stops the thread. Takes up to 20 ms.
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    // The loop's side.
    /// The loop is at work. It is watched from its first beat on.
    void beat(base::TimePoint now)
    {
        last_beat_.store(now.time_since_epoch().count(), std::memory_order_release);
    }
    /// The loop has ended in order.
    void rest() { last_beat_.store(resting, std::memory_order_release); }
    /// True if the loop was silent for so long that its governor has to latch a fault. True once
    /// per silence.
    [[nodiscard]] bool take_fault() { return fault_.exchange(false, std::memory_order_acq_rel); }
    /// The program is dying: no force may follow. The loop ends by itself then, too, because the
    /// thread that crashed may be the watchdog's.
    [[nodiscard]] bool is_dying() const
    {
        return dying_.load(std::memory_order_acquire) ||
               (crash_ != nullptr && net::CrashSignal::has_come());
    }

    /// The time when the loop last worked; it stays the same while the loop does not move. Call it
    /// from any thread.
    [[nodiscard]] base::TimePoint last_beat() const
    {
        return base::TimePoint{base::Duration{last_beat_.load(std::memory_order_acquire)}};
    }

    /// Number of silences in which it halted the device. When this has changed since a tick began,
    /// the force of that tick is outdated.
    [[nodiscard]] std::uint64_t halts() const { return halts_.load(std::memory_order_acquire); }

    static constexpr base::Duration halt_after{std::chrono::milliseconds{20}};
    static constexpr base::Duration fault_after{std::chrono::milliseconds{100}};
    /// The device of a silent loop is halted repeatedly: a wire may lose one message.
    static constexpr base::Duration halt_every{std::chrono::milliseconds{5}};

private:
    static constexpr base::Duration::rep resting = -1;

    void watch();
    [[nodiscard]] base::TimePoint look(base::TimePoint now);
    void halt_for_good();

    device::Device& device_;
    const net::CrashSignal* crash_;
    std::atomic<base::Duration::rep> last_beat_{resting}; // time of the last beat, or `resting`
    std::atomic<bool> fault_{false};
    std::atomic<bool> dying_{false};
    std::atomic<bool> ending_{false};
    std::atomic<std::uint64_t> halts_{0};
    Alarm alarm_ = Alarm::none; // alarm of the present silence; the watching thread's own
    std::thread thread_;        // declared last: it uses the other members
};

} // namespace hapnet::peer::loop

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "proto/net/crash_signal.hpp"

#include <atomic>
#include <cstdint>
#include <thread>

namespace hapnet::peer::loop {

/// The action after the loop has been silent.
enum class Alarm : std::uint8_t {
    none,
    halt,  // silent for longer than any tick takes: zero force
    fault, // silent for longer than the governor tolerates: also a fault
};
[[nodiscard]] Alarm alarm_after(base::Duration silence);

/// Watches a loop from its own thread, and halts the device in place of the loop when there was no
/// beat for 20 ms or when the program is crashing. The thread sleeps until a beat is overdue. Its
/// real-time priority is above that of the loop, if the system grants it.
class Watchdog {
public:
    /// Both arguments must outlive it. If `crash` is nullptr, it does not act when the program
    /// crashes.
    explicit Watchdog(device::Device& device, const net::CrashSignal* crash = nullptr);
    /// Stops the thread. Takes up to 20 ms.
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    // Reports that the loop is working. Monitoring begins with the first beat. For the loop.
    void beat(base::TimePoint now)
    {
        last_beat_.store(now.time_since_epoch().count(), std::memory_order_release);
    }
    /// Reports that the loop has ended in an orderly way.
    void rest() { last_beat_.store(resting, std::memory_order_release); }
    /// Returns true, once per silence, if the loop was silent for so long that its governor must
    /// latch a fault.
    [[nodiscard]] bool take_fault() { return fault_.exchange(false, std::memory_order_acq_rel); }
    /// True if the program is crashing, so that no force may follow. The loop must then also end by
    /// itself, because the crashed thread may be the watchdog's.
    [[nodiscard]] bool is_dying() const
    {
        return dying_.load(std::memory_order_acquire) ||
               (crash_ != nullptr && net::CrashSignal::has_come());
    }

    /// Returns the time of the last beat, which does not change while the loop makes no progress.
    /// Call it from any thread.
    [[nodiscard]] base::TimePoint last_beat() const
    {
        return base::TimePoint{base::Duration{last_beat_.load(std::memory_order_acquire)}};
    }

    /// Returns the number of silences in which the watchdog halted the device. If it has changed
    /// since a tick began, the force of that tick is outdated.
    [[nodiscard]] std::uint64_t halts() const { return halts_.load(std::memory_order_acquire); }

    static constexpr base::Duration halt_after{std::chrono::milliseconds{20}};
    static constexpr base::Duration fault_after{std::chrono::milliseconds{100}};
    /// The interval at which the device of a silent loop is halted again, because one message may
    /// be lost on the wire.
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
    Alarm alarm_ = Alarm::none; // alarm of the present silence; used by the watching thread only
    std::thread thread_;        // last member: it uses the others
};

} // namespace hapnet::peer::loop

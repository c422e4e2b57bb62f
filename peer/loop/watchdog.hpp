// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "proto/net/crash_signal.hpp"

#include <atomic>
#include <cstdint>
#include <thread>

namespace hapnet::peer {

/// What is to be done about a loop that has not been heard for so long.
enum class Alarm : std::uint8_t {
    none,
    halt,  // longer than any turn takes: zero force
    fault, // longer than the governor lets pass: it has to be told, too
};
[[nodiscard]] Alarm alarm_after(base::Duration silence);

/// Watches a loop from a thread of its own, and lets go of the device in its stead: when no beat
/// came for 20 ms, and when the program dies. Sleeps until a beat is overdue; real-time priority
/// above the loop's, where the system grants it.
class Watchdog {
public:
    /// Both outlive it. `crash` may be null: then a dying program is not its affair.
    explicit Watchdog(device::Device& device, const net::CrashSignal* crash = nullptr);
    /// Within 20 ms.
    ~Watchdog();
    Watchdog(const Watchdog&) = delete;
    Watchdog& operator=(const Watchdog&) = delete;

    // The loop's side.
    /// It is at work. It is watched from the first beat on.
    void beat(base::TimePoint now)
    {
        last_beat_.store(now.time_since_epoch().count(), std::memory_order_release);
    }
    /// It has ended in order.
    void rest() { last_beat_.store(resting, std::memory_order_release); }
    /// Whether it was silent for so long that its governor has to latch a fault; once per silence.
    [[nodiscard]] bool take_fault() { return fault_.exchange(false, std::memory_order_acq_rel); }
    /// The program is dying: no force may follow any more. The loop ends then by itself, too: it
    /// may be this one's thread that crashed.
    [[nodiscard]] bool is_dying() const
    {
        return dying_.load(std::memory_order_acquire) ||
               (crash_ != nullptr && net::CrashSignal::has_come());
    }

    /// Silences in which it had to let go of the device. The loop's side, too: where this has
    /// changed since the turn began, the turn's force is an old one.
    [[nodiscard]] std::uint64_t halts() const { return halts_.load(std::memory_order_acquire); }

    static constexpr base::Duration halt_after{std::chrono::milliseconds{20}};
    static constexpr base::Duration fault_after{std::chrono::milliseconds{100}};
    /// A silent loop's device is told again and again: a wire may lose one word.
    static constexpr base::Duration halt_every{std::chrono::milliseconds{5}};

private:
    static constexpr base::Duration::rep resting = -1;

    void watch();
    [[nodiscard]] base::TimePoint look(base::TimePoint now);
    void let_go_for_good();

    device::Device& device_;
    const net::CrashSignal* crash_;
    std::atomic<base::Duration::rep> last_beat_{resting}; // on the timeline
    std::atomic<bool> fault_{false};
    std::atomic<bool> dying_{false};
    std::atomic<bool> ending_{false};
    std::atomic<std::uint64_t> halts_{0};
    Alarm alarm_ = Alarm::none; // of the silence now; the watching thread's own
    std::thread thread_;        // last: it uses the others
};

} // namespace hapnet::peer

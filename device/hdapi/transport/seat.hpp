// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hdapi/device_cycle.hpp"
#include "device/hdapi/latest.hpp"

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>

namespace hapnet::device::hdapi {

/// One device's place in the scheduler: what its callback and the device's own thread share.
class Seat {
public:
    explicit Seat(const DeviceCycle& cycle) : cycle_{cycle} {}

    // The scheduler's thread.
    void serve();

    // The device's thread.
    /// The newest report.
    [[nodiscard]] const Report& report();
    void command(const Command& command);
    /// As Device::pace().
    void pace(const std::function<bool()>& beat);
    /// Zero force from now on; returns when at least three frames have carried it, or 200 ms on.
    void fall_silent();
    [[nodiscard]] Handle handle() const { return cycle_.handle(); }

    // Any thread.
    void halt() noexcept { halted_.store(true, std::memory_order_release); }

private:
    enum class Beat : std::uint8_t { none, waiting, running, ended };

    void run_beat();
    template <typename Condition>
    void wait_while_cycles_come(std::unique_lock<std::mutex>& lock, Condition is_over);

    DeviceCycle cycle_;
    Latest<Report> reports_;
    Latest<Command> commands_;
    std::atomic<bool> halted_{false};
    std::atomic<bool> closing_{false};
    std::atomic<std::uint64_t> cycles_{0};
    std::atomic<Beat> beat_state_{Beat::none};
    const std::function<bool()>* beat_ = nullptr; // while beat_state_ is not none
    std::exception_ptr failure_;
    bool is_silent_ = false; // guarded by mutex_
    std::mutex mutex_;
    std::condition_variable changed_;
};

} // namespace hapnet::device::hdapi

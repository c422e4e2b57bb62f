// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hdapi/device_cycle.hpp"
#include "device/triple_buffer.hpp"

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>

namespace hapnet::device::hdapi {

/// One device in the scheduler, shared by the scheduler's callback and the device's own thread. The
/// loop runs on the device's own thread and never inside the callback. If it hung in the callback,
/// nothing could set zero force any more.
class SchedulerClient {
public:
    explicit SchedulerClient(const DeviceCycle& cycle) : cycle_{cycle} {}

    /// Ends the silence of begin_silence(). Call it while the scheduler is stopped.
    void on_start();

    // For the scheduler's thread:
    void serve();
    void note(unsigned int error) { cycle_.note(error); }

    // For the device's thread:
    /// Returns the newest report.
    [[nodiscard]] const Report& report();
    void command(const Command& command);
    /// Paces the loop like Device::pace(). `beat` runs on the calling thread.
    void pace(const std::function<bool()>& beat);
    [[nodiscard]] Handle handle() const { return cycle_.handle(); }

    // For any thread:
    /// Sets zero force from the library's next cycle on.
    void halt() noexcept { halted_.store(true, std::memory_order_release); }
    /// Sets zero force until the scheduler starts again, whatever is commanded.
    void begin_silence() { hushed_.store(true, std::memory_order_release); }
    /// Returns when at least three frames after begin_silence() have carried zero force, or when no
    /// cycle came for 100 ms.
    void await_silence();

private:
    enum class Beat : std::uint8_t {
        none,
        awaited, // the next cycle requests a beat
        due,     // a beat was requested and has not ended
    };

    void call_for_a_beat();
    [[nodiscard]] bool is_called();

    DeviceCycle cycle_;
    TripleBuffer<Report> reports_;
    TripleBuffer<Command> commands_;
    std::atomic<bool> halted_{false};
    std::atomic<bool> hushed_{false};
    std::atomic<std::uint64_t> cycles_{0};
    std::mutex mutex_; // guards beat_ and is_silent_
    Beat beat_ = Beat::none;
    bool is_silent_ = false;
    std::condition_variable changed_;
};

} // namespace hapnet::device::hdapi

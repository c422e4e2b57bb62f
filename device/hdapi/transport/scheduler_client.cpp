// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/transport/scheduler_client.hpp"

#include <chrono>

namespace hapnet::device::hdapi {

namespace {

constexpr std::uint64_t silent_frames_wanted = 3;
constexpr std::chrono::milliseconds no_cycle_max{100};
// Half a cycle at 1 kHz: a beat takes some 20 us.
constexpr std::chrono::microseconds beat_max{500};

} // namespace

void SchedulerClient::on_start()
{
    const std::lock_guard lock{mutex_};
    is_silent_ = false;
    hushed_.store(false, std::memory_order_release);
    cycle_.on_start();
}

void SchedulerClient::serve()
{
    reports_.put(cycle_.begin());
    call_for_a_beat();
    const bool is_new = commands_.take();
    const bool is_quiet =
        halted_.load(std::memory_order_acquire) || hushed_.load(std::memory_order_acquire);
    cycle_.end(is_quiet ? Command{} : commands_.value(), is_new);
    cycles_.fetch_add(1, std::memory_order_release);
    if (!hushed_.load(std::memory_order_acquire)) return;
    if (cycle_.silent_frames() < silent_frames_wanted) return;
    const std::lock_guard lock{mutex_};
    is_silent_ = true;
    changed_.notify_all();
}

/// Requests a beat. The force of this frame is that of the beat if it ends in time; otherwise a
/// later frame has it. A beat that has not ended is not waited for again: even if it hangs, the
/// library's thread continues, and so do the frames that remove the force. This function does not
/// wait for the lock either, because the system may have suspended its owner: then the next cycle
/// requests the beat.
void SchedulerClient::call_for_a_beat()
{
    std::unique_lock lock{mutex_, std::try_to_lock};
    if (!lock || beat_ != Beat::awaited) return;
    beat_ = Beat::due;
    changed_.notify_all();
    changed_.wait_for(lock, beat_max, [this] { return beat_ != Beat::due; });
}

const Report& SchedulerClient::report()
{
    reports_.take();
    return reports_.value();
}

void SchedulerClient::command(const Command& command)
{
    commands_.put(command); // first: a command from before the halt must not come back for a cycle
    halted_.store(false, std::memory_order_release);
}

void SchedulerClient::pace(const std::function<bool()>& beat)
{
    for (bool goes_on = true; goes_on && is_called();) {
        goes_on = beat(); // if it throws, it stays due, and no cycle waits for it again
        {
            const std::lock_guard lock{mutex_};
            beat_ = Beat::none;
        }
        changed_.notify_all(); // without the lock: the thread that wakes needs it first
    }
}

/// True if a cycle has requested a beat; false: none came for 100 ms.
bool SchedulerClient::is_called()
{
    std::unique_lock lock{mutex_};
    beat_ = Beat::awaited;
    if (changed_.wait_for(lock, no_cycle_max, [this] { return beat_ == Beat::due; })) return true;
    beat_ = Beat::none;
    return false;
}

void SchedulerClient::await_silence()
{
    std::unique_lock lock{mutex_};
    std::uint64_t before = 0;
    do {
        before = cycles_.load(std::memory_order_acquire);
        if (changed_.wait_for(lock, no_cycle_max, [this] { return is_silent_; })) return;
    } while (cycles_.load(std::memory_order_acquire) != before);
}

} // namespace hapnet::device::hdapi

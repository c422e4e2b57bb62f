// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/transport/seat.hpp"

#include <chrono>
#include <utility>

namespace hapnet::device::hdapi {

namespace {

constexpr std::uint64_t silent_frames_wanted = 3;
constexpr std::chrono::milliseconds look_every{20};
constexpr int looks_without_a_cycle_max = 5; // 100 ms

} // namespace

void Seat::serve()
{
    reports_.put(cycle_.begin());
    run_beat();
    const bool is_new = commands_.take();
    const bool is_quiet =
        halted_.load(std::memory_order_acquire) || closing_.load(std::memory_order_acquire);
    cycle_.end(is_quiet ? Command{} : commands_.value(), is_new);
    cycles_.fetch_add(1, std::memory_order_release);
    if (!closing_.load(std::memory_order_acquire)) return;
    if (cycle_.silent_frames() < silent_frames_wanted) return;
    const std::lock_guard lock{mutex_};
    is_silent_ = true;
    changed_.notify_all();
}

void Seat::run_beat()
{
    auto expected = Beat::waiting;
    if (!beat_state_.compare_exchange_strong(expected, Beat::running)) return;
    bool goes_on = false;
    try {
        goes_on = (*beat_)();
    } catch (...) {
        failure_ = std::current_exception(); // it must not cross the library
    }
    if (goes_on) {
        beat_state_.store(Beat::waiting);
        return;
    }
    const std::lock_guard lock{mutex_};
    beat_state_.store(Beat::ended);
    changed_.notify_all();
}

const Report& Seat::report()
{
    reports_.take();
    return reports_.value();
}

void Seat::command(const Command& command)
{
    commands_.put(command); // first: what was said before the halt must not come back for a cycle
    halted_.store(false, std::memory_order_release);
}

template <typename Condition>
void Seat::wait_while_cycles_come(std::unique_lock<std::mutex>& lock, Condition is_over)
{
    int looks_in_vain = 0;
    std::uint64_t before = cycles_.load(std::memory_order_acquire);
    while (!changed_.wait_for(lock, look_every, is_over)) {
        const std::uint64_t cycles = cycles_.load(std::memory_order_acquire);
        looks_in_vain = cycles == before ? looks_in_vain + 1 : 0;
        before = cycles;
        if (looks_in_vain >= looks_without_a_cycle_max) return;
    }
}

void Seat::pace(const std::function<bool()>& beat)
{
    beat_ = &beat;
    beat_state_.store(Beat::waiting);
    std::unique_lock lock{mutex_};
    const auto has_ended = [this] { return beat_state_.load() == Beat::ended; };
    while (!has_ended()) {
        wait_while_cycles_come(lock, has_ended);
        auto expected = Beat::waiting;
        // A beat under way ends by itself.
        if (beat_state_.compare_exchange_strong(expected, Beat::none)) return;
    }
    beat_state_.store(Beat::none);
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Seat::fall_silent()
{
    std::unique_lock lock{mutex_};
    closing_.store(true, std::memory_order_release);
    wait_while_cycles_come(lock, [this] { return is_silent_; });
}

} // namespace hapnet::device::hdapi

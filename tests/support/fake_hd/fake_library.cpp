// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/fake_hd/fake_library.hpp"

#include <ctime>

namespace hapnet::device::hdapi {

namespace {

constexpr long period_ns = 1'000'000;

timespec later(timespec time)
{
    time.tv_nsec += period_ns;
    if (time.tv_nsec >= 1'000'000'000) {
        time.tv_nsec -= 1'000'000'000;
        ++time.tv_sec;
    }
    return time;
}

} // namespace

Library& library()
{
    // Never destroyed: like the real one it may be in use when the process ends.
    static Library& it = *new Library;
    return it;
}

void run_scheduler()
{
    Library& it = library();
    timespec due{};
    clock_gettime(CLOCK_MONOTONIC, &due);
    while (it.running) {
        due = later(due);
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr);
        Callback callback = nullptr;
        void* data = nullptr;
        {
            const std::lock_guard lock{it.mutex};
            callback = it.callback;
            data = it.data;
        }
        if (it.stalled || callback == nullptr) continue;
        if (callback(data) != callback_continue) {
            const std::lock_guard lock{it.mutex};
            it.callback = nullptr;
        }
    }
}

void stop_scheduler()
{
    Library& it = library();
    if (!it.running.exchange(false)) return;
    it.scheduler.join();
}

} // namespace hapnet::device::hdapi

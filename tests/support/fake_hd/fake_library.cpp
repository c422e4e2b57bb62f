// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/fake_hd/fake_library.hpp"

#include <cstdlib>
#include <ctime>

namespace hapnet::device::hdapi {

namespace {

constexpr long period_ns = 1'000'000;
constexpr std::size_t frames_in_inkwell = 100;

timespec later(timespec time)
{
    time.tv_nsec += period_ns;
    if (time.tv_nsec >= 1'000'000'000) {
        time.tv_nsec -= 1'000'000'000;
        ++time.tv_sec;
    }
    return time;
}

Library* new_library()
{
    auto* it = new Library;
    const char* file = std::getenv(fake_hd_log_variable);
    if (file == nullptr) return it;
    it->log.open(file);
    for (FakeDevice& device : it->devices) device.docked = true;
    return it;
}

} // namespace

Library& library()
{
    // Never destroyed: like the real library it may be in use when the process ends.
    static Library& it = *new_library();
    return it;
}

void note(Handle handle, const FakeHdCommand& command)
{
    Library& it = library();
    FakeDevice& device = it.devices.at(handle);
    device.commands.push_back(command);
    if (!it.log.is_open()) return;
    const auto& force = command.force_n;
    it.log << handle << ' ' << force[0] << ' ' << force[1] << ' ' << force[2] << ' '
           << command.motors_on << std::endl; // written before the next frame
    if (device.calibrated && device.commands.size() > frames_in_inkwell) device.docked = false;
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

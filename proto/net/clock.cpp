// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/clock.hpp"

#include "proto/base/ensure.hpp"

#include <cerrno>
#include <ctime>
#include <fstream>
#include <sys/random.h>
#include <sys/timex.h>

namespace hapnet::net {

namespace {

base::Duration time_of(clockid_t clock)
{
    timespec now{};
    base::ensure(clock_gettime(clock, &now) == 0);
    return std::chrono::seconds{now.tv_sec} + std::chrono::nanoseconds{now.tv_nsec};
}

/// monotonic_now() minus the time since the machine's start. It is written before there are
/// threads.
base::Duration date_of_boot{};

} // namespace

base::TimePoint monotonic_now() { return base::TimePoint{since_boot() + date_of_boot}; }

base::Duration since_boot() { return time_of(CLOCK_BOOTTIME); }

/// The common date is the last multiple of 2^28 s (8.5 years) since 1970. So the clock of a host
/// that counts from its start is less than ten years away, which peers accept as an offset.
void count_from_common_date()
{
    constexpr base::Duration apart = std::chrono::seconds{1 << 28};
    const base::Duration since_1970 = since_boot() - (monotonic_minus_real() - date_of_boot);
    date_of_boot = since_1970 % apart - since_boot();
}

std::optional<base::Duration> stated_clock_error()
{
    ntptimeval stated{};
    const int state = ntp_gettime(&stated);
    if (state < 0 || state == TIME_ERROR) return std::nullopt;
    return std::chrono::microseconds{stated.maxerror};
}

base::Duration thread_processor_time() { return time_of(CLOCK_THREAD_CPUTIME_ID); }

base::Duration program_processor_time() { return time_of(CLOCK_PROCESS_CPUTIME_ID); }

/// An interruption between two readings would shift the stamps, so the closest of a few readings
/// counts. Usually it is the first.
base::Duration monotonic_minus_real()
{
    constexpr int readings_max = 4;
    constexpr base::Duration close_enough = std::chrono::microseconds{1};
    auto closest = base::Duration::max();
    base::Duration offset{};
    for (int i = 0; i < readings_max && closest > close_enough; ++i) {
        timespec real{};
        const auto before = monotonic_now().time_since_epoch();
        base::ensure(clock_gettime(CLOCK_REALTIME, &real) == 0);
        const auto since_1970 =
            std::chrono::seconds{real.tv_sec} + std::chrono::nanoseconds{real.tv_nsec};
        const auto took = monotonic_now().time_since_epoch() - before;
        if (took >= closest) continue;
        closest = took;
        offset = before + took / 2 - since_1970;
    }
    return offset;
}

double wall_clock_seconds() { return 1e-9 * static_cast<double>(wall_clock_nanoseconds()); }

std::int64_t wall_clock_nanoseconds()
{
    timespec now{};
    base::ensure(clock_gettime(CLOCK_REALTIME, &now) == 0);
    return now.tv_sec * 1'000'000'000 + now.tv_nsec;
}

void sleep_until(base::TimePoint when)
{
    const auto since_start = when.time_since_epoch() - date_of_boot;
    const auto seconds = std::chrono::floor<std::chrono::seconds>(since_start);
    timespec until{};
    until.tv_sec = seconds.count();
    until.tv_nsec = (since_start - seconds).count();
    while (clock_nanosleep(CLOCK_BOOTTIME, TIMER_ABSTIME, &until, nullptr) == EINTR) {}
}

std::string boot_id()
{
    std::ifstream file{"/proc/sys/kernel/random/boot_id"};
    std::string id;
    file >> id;
    return id;
}

std::uint64_t unpredictable_bits()
{
    std::uint64_t bits = 0;
    base::ensure(getrandom(&bits, sizeof bits, 0) == static_cast<ssize_t>(sizeof bits));
    return bits;
}

} // namespace hapnet::net

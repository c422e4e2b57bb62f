// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::net {

/// Returns the time of CLOCK_BOOTTIME. It never steps, and it also runs while the machine is
/// suspended. So a loop notices the gap, and the motors count as cooled. The project has no other
/// clock. A shell calls this once per wake-up.
[[nodiscard]] base::TimePoint monotonic_now();

/// Returns the time since the machine's start, suspended or not.
[[nodiscard]] base::Duration since_boot();

/// Lets monotonic_now() count from a date that all hosts have in common instead of from the
/// machine's start. It then agrees with that of other hosts as well as their wall clocks do. It
/// still never steps: a later step of the wall clock is not followed. Call it once, before the
/// program reads the clock and starts threads.
void count_from_common_date();

/// Returns the largest error of the wall clock, as the service that disciplines it (NTP, PTP) has
/// told the kernel; nullopt if none does.
[[nodiscard]] std::optional<base::Duration> stated_clock_error();

/// Returns the processor time that the calling thread has used, in user and kernel mode. It makes a
/// system call.
[[nodiscard]] base::Duration thread_processor_time();

/// Returns the processor time that all threads of this program have used. It makes a system call.
[[nodiscard]] base::Duration program_processor_time();

/// Returns the time of day in seconds since 1970. Use it only for manifests, file names, captures
/// and data that outlives the program.
[[nodiscard]] double wall_clock_seconds();

/// Returns the time of day in nanoseconds since 1970, for dates. It may step either way.
[[nodiscard]] std::int64_t wall_clock_nanoseconds();
/// Returns monotonic_now() minus CLOCK_REALTIME, the clock of the kernel's receive stamps.
[[nodiscard]] base::Duration monotonic_minus_real();

/// Sleeps until monotonic_now() reaches `when`. Returns at once if it already has.
void sleep_until(base::TimePoint when);

/// Returns the identity of this boot of this machine; empty if the system does not provide it. Two
/// records with equal boot ids have one clock, so their times can be compared directly, unless
/// their echoes rule that out (base::are_two_clocks).
[[nodiscard]] std::string boot_id();

/// Returns 64 bits from the kernel's random source, for session nonces and never for an experiment.
[[nodiscard]] std::uint64_t unpredictable_bits();

} // namespace hapnet::net

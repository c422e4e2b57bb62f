// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstdint>
#include <string>

namespace hapnet::net {

/// CLOCK_BOOTTIME: it never steps. It also runs while the machine is suspended, so that a loop
/// notices the gap and the motors count as cooled. The project has no other clock; a shell calls it
/// once per wake-up.
[[nodiscard]] base::TimePoint monotonic_now();

/// The processor time that the calling thread has used, in the kernel and out of it. A system call.
[[nodiscard]] base::Duration thread_processor_time();

/// The processor time that all threads of this program have used so far. A system call.
[[nodiscard]] base::Duration program_processor_time();

/// The time of day in seconds since 1970, for manifests, file names, captures
/// and what outlives a program only.
[[nodiscard]] double wall_clock_seconds();

/// The time of day in nanoseconds since 1970, for what is dated; it may step either way.
[[nodiscard]] std::int64_t wall_clock_nanoseconds();
/// The clock of monotonic_now() minus CLOCK_REALTIME, in which the kernel stamps what arrives.
[[nodiscard]] base::Duration monotonic_minus_real();

/// Sleeps until `when` on that clock; returns at once when it has passed.
void sleep_until(base::TimePoint when);

/// The identity of this boot of this machine: two records with equal boot ids have one
/// clock and compare directly, unless their echoes rule that out (base::are_two_clocks). Empty when
/// the system does not tell.
[[nodiscard]] std::string boot_id();

/// 64 bits from the kernel's random source, for session nonces; never for an experiment.
[[nodiscard]] std::uint64_t unpredictable_bits();

} // namespace hapnet::net

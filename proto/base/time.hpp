// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>

namespace hapnet::base {

/// The one clock of the cores. It has no now(), so a core that reads a clock does not compile.
/// Shells take its times from CLOCK_BOOTTIME, and virtual time takes them from a counter.
struct Timeline {
    using duration = std::chrono::nanoseconds;
    using rep = duration::rep;
    using period = duration::period;
    using time_point = std::chrono::time_point<Timeline>;
    static constexpr bool is_steady = true;
};

using Duration = Timeline::duration;
using TimePoint = Timeline::time_point;

/// True if there is a deadline and it has passed. A plain comparison would be wrong, because
/// `std::nullopt <= now` is true.
[[nodiscard]] constexpr bool is_due(std::optional<TimePoint> deadline, TimePoint now)
{
    return deadline.has_value() && *deadline <= now;
}

/// Returns the earlier of two deadlines; nullopt means never.
[[nodiscard]] constexpr std::optional<TimePoint> earlier(std::optional<TimePoint> a,
                                                         std::optional<TimePoint> b)
{
    if (!a) return b;
    if (!b) return a;
    return *a < *b ? a : b;
}

/// Converts a duration to a floating-point number of seconds, for physics.
[[nodiscard]] constexpr double to_seconds(Duration duration)
{
    return std::chrono::duration<double>{duration}.count();
}

/// Converts a duration to a floating-point number of nanoseconds. It is exact below 104 days.
[[nodiscard]] constexpr double to_nanoseconds(Duration duration)
{
    return static_cast<double>(duration.count());
}

/// Returns the duration nearest to `seconds`, which must be finite and below 292 years.
[[nodiscard]] constexpr Duration from_seconds(double seconds)
{
    const double nanoseconds = seconds * 1e9;
    return Duration{
        static_cast<Duration::rep>(nanoseconds < 0 ? nanoseconds - 0.5 : nanoseconds + 0.5)};
}

} // namespace hapnet::base

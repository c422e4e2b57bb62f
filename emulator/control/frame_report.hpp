// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/pulse.hpp"
#include "emulator/core/statistics.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

// The frame of an emulator: docs/formats/live.md.

/// The traffic of one direction of a path since the previous frame. The number of waiting datagrams
/// is the current one.
struct WayFrame {
    Counters counters;
    Pulse pulse;
};
constexpr auto fields_of(base::Tag<WayFrame>)
{
    using W = WayFrame;
    return base::fields("way", base::part(&W::counters).without_zeros(),
                        base::computed<W>(
                            "delay_ms", [](const W& way) { return way.pulse.delay(); },
                            "From arrival to departure of what was delivered. null: nothing was.")
                            .rounded(4),
                        base::computed<W>(
                            "late_us", [](const W& way) { return way.pulse.late(); },
                            "Time sent minus time due. null: nothing was delivered.")
                            .rounded(1));
}

struct PathFrame {
    std::string name;
    WayFrame up;
    WayFrame down;
};
constexpr auto fields_of(base::Tag<PathFrame>)
{
    return base::fields("path",
                        base::member("name", &PathFrame::name,
                                     "Empty for the only path, or that of a link or a client."),
                        base::member("up", &PathFrame::up), base::member("down", &PathFrame::down));
}

struct EmulatorFrame {
    bool is_ok = true;
    std::uint64_t number = 0;
    base::TimePoint at{};
    base::Duration elapsed{};
    std::uint64_t generation = 1;
    std::vector<PathFrame> paths;
    std::optional<std::uint64_t> paths_left_out{};
    std::optional<std::uint64_t> left_out{};
};
constexpr auto fields_of(base::Tag<EmulatorFrame>)
{
    using F = EmulatorFrame;
    return base::fields(
        "emulator frame", base::member("ok", &F::is_ok),
        base::member("frame", &F::number, "Its number, from 0."),
        base::computed<F>(
            "at_ns", [](const F& frame) { return frame.at.time_since_epoch().count(); },
            "When it was taken, CLOCK_BOOTTIME."),
        base::member("elapsed_s", &F::elapsed, "The time since the start of the run.").rounded(4),
        base::member("generation", &F::generation,
                     "How often the conditions have changed, plus 1."),
        base::member("paths", &F::paths, "The paths, 32 at most."),
        base::member("paths_left_out", &F::paths_left_out, "How many more there are.")
            .left_out_if_none(),
        base::member("left_out", &F::left_out,
                     "Frames that were due since the one before, and were not sent.")
            .left_out_if_none());
}

} // namespace hapnet::emulator

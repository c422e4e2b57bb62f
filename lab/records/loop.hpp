// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/session.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/figures/quantiles.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace hapnet::lab::records {

/// The lateness that 99 % of the ticks of a valid session do not exceed. A tick that is late by one
/// tick has an error of one tick.
inline constexpr base::Duration tick_lateness_max{std::chrono::milliseconds{1}};

/// The punctuality of one peer's haptic loop, from T0 to its end.
struct Loop {
    std::uint64_t ticks = 0;
    std::uint64_t missed = 0;
    /// The rate of the ticks; nullopt with fewer than two ticks.
    std::optional<double> rate_hz;
    std::optional<base::Quantiles> late;

    /// Returns the share of the due ticks that were skipped, 0 to 1.
    [[nodiscard]] double missed_share() const
    {
        const auto due = static_cast<double>(ticks + missed);
        return due > 0 ? static_cast<double>(missed) / due : 0.0;
    }
};

constexpr auto fields_of(base::Tag<Loop>)
{
    return base::fields(
        "ticks", base::member("rate_hz", &Loop::rate_hz, "Ticks per second."),
        base::member("missed", &Loop::missed, "Ticks skipped."),
        base::computed<Loop>(
            "late_us",
            [](const Loop& loop) -> std::optional<base::MainQuantiles> { return loop.late; },
            "The lateness of waking; null without ticks."));
}

/// The report on a peer's loop in an analysis.
struct LoopReport {
    Loop tick;
};
constexpr auto fields_of(base::Tag<LoopReport>)
{
    return base::fields("loop", base::member("tick", &LoopReport::tick, "Of this session alone."));
}

[[nodiscard]] Loop loop_of(const Side& side);

} // namespace hapnet::lab::records

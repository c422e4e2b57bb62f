// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "peer/core/peer.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/figures/quantiles.hpp"
#include "proto/base/value_kind.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::peer {

// The parts of a peer's statistics that exist both in real time and in virtual time.

/// The punctuality of a loop.
struct TickReport {
    std::uint64_t count = 0;
    std::uint64_t missed = 0;
    std::optional<base::Quantiles> late{};

    [[nodiscard]] double missed_share() const
    {
        const auto all = static_cast<double>(count + missed);
        return all > 0.0 ? static_cast<double>(missed) / all : 0.0;
    }
};
constexpr auto fields_of(base::Tag<TickReport>)
{
    using T = TickReport;
    return base::fields(
        "ticks",
        base::member("count", &T::count, "Ticks since the program started.")
            .counter("hapnet_peer_ticks"),
        base::member("missed", &T::missed, "Ticks skipped because an earlier one ended too late.")
            .counter("hapnet_peer_ticks_missed"),
        base::computed<T>(
            "missed_share", [](const T& ticks) { return ticks.missed_share(); },
            "missed / (count + missed)."),
        base::member("late_us", &T::late, "The lateness of waking; null before the first tick.")
            .gauge("hapnet_peer_tick_lateness"));
}

constexpr auto fields_of(base::Tag<Counters>)
{
    using C = Counters;
    return base::fields(
        "messages",
        base::member("states_sent", &C::sent, "State messages of all sessions.")
            .counter("hapnet_peer_states_sent"),
        base::member("sending", &C::sending,
                     "Ticks of all sessions: those whose message was held back, and the others by "
                     "what their message was [sent for](../use/peer.md#sending-less).")
            .counter("hapnet_peer_ticks_by_message", "cause"),
        base::member("states_received", &C::states, "State messages that were used.")
            .counter("hapnet_peer_states_received"),
        base::member("outdated", &C::outdated,
                     "Older than one already used, or duplicates: not used by default.")
            .counter("hapnet_peer_states_outdated"),
        base::member("played_late", &C::played_late,
                     "State messages that came after their "
                     "[playout time](../use/peer.md#playout); 0 without a playout.")
            .counter("hapnet_peer_states_played_late"),
        base::member("other_session", &C::other_session,
                     "State messages of another session, or after the other peer's goodbye; hellos "
                     "of another peer than the one of that address."),
        base::member("hellos", &C::hellos,
                     "Such messages received from the peer that is expected there."),
        base::member("byes", &C::byes, "Likewise."),
        base::member("malformed", &C::malformed, "Datagrams that are no message."),
        base::member("other_version", &C::other_version, "Messages of another version."),
        base::member("implausible", &C::implausible,
                     "Positions or speeds beyond the scene, another body, numbers ahead of time or "
                     "of their own stamp, stamps ahead of their arrival."));
}

/// Counters and states of the governor, which stands between the loop and the motors.
struct GovernorFigures {
    device::GovernorState state = device::GovernorState::off;
    device::Latched fault{};
    double force_limit_n = 0.0;
    double motor_heat = 0.0;
    device::GovernorCounters counters{};
    device::RigCounters device{};
};
[[nodiscard]] GovernorFigures governor_figures(const device::Rig& rig);
constexpr auto fields_of(base::Tag<GovernorFigures>)
{
    using F = GovernorFigures;
    return base::fields(
        "governor", base::member("state", &F::state, "[State](../design/governor.md#states)."),
        base::computed<F>(
            "fault", [](const F& one) { return one.fault.fault; },
            "The latched fault; `none` without one."),
        base::computed<F>(
            "tripped_by", [](const F& one) { return one.fault.trip; }, "Its cause."),
        base::member("force_limit_n", &F::force_limit_n,
                     "The limit that holds: the lesser of option and device."),
        base::member("motor_heat", &F::motor_heat,
                     "Heat of the motors by the model; above 1 the limit is lower."),
        base::part(&F::counters), base::member("device", &F::device, "Reports of the device."));
}

/// The role of a peer.
enum class Role : std::uint8_t { left, right };
constexpr auto names_of(base::Tag<Role>) { return base::names("L", "R"); }

} // namespace hapnet::peer

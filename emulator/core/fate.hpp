// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace hapnet::emulator {

/// The reason why a datagram that was received did not leave.
enum class DropCause : std::uint8_t {
    // Configured losses, by the law that dropped the datagram.
    random_loss,
    block_loss,
    periodic_loss,
    burst_loss,
    gilbert_elliott,
    four_state,
    listed_loss,
    pattern_loss,
    trace_loss,
    outage,
    // Other causes.
    mtu,              // larger than the configured limit
    rate_queue_full,  // no room in the queue of the configured rate
    rate_queue_law,   // dropped by the law of that queue, such as CoDel
    replay_ended,     // more datagrams than the fates that are replayed
    queue_full,       // the emulator's own limit of datagrams in flight
    no_destination,   // the other side was not known yet
    no_route,         // the system had no route to the other side
    refused,          // the other machine answered that no program listens there
    too_big,          // too large for the outgoing interface or route
    send_buffer_full, // the system's send buffer had no room
    send_failed,      // the system refused to send for another reason
};

/// Names each cause as the key in statistics does: "random_loss".
constexpr auto names_of(base::Tag<DropCause>)
{
    return base::names("random_loss", "block_loss", "periodic_loss", "burst_loss",
                       "gilbert_elliott", "four_state", "listed_loss", "pattern_loss", "trace_loss",
                       "outage", "mtu", "rate_queue_full", "rate_queue_law", "replay_ended",
                       "queue_full", "no_destination", "no_route", "refused", "too_big",
                       "send_buffer_full", "send_failed");
}
[[nodiscard]] constexpr std::string_view to_text(DropCause cause) { return base::name_of(cause); }

/// Every cause of a drop, in order.
inline constexpr auto drop_causes = [] {
    std::array<DropCause, base::names_of_enum<DropCause>.size()> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<DropCause>(i);
    return all;
}();

/// The bits of a datagram that are inverted: each number, modulo the number of bits of the
/// datagram, is a position. So a fate does not depend on the length of the datagram.
struct Flips {
    static constexpr std::size_t most = 8;

    std::array<std::uint32_t, most> places{};
    std::uint8_t count = 0;

    friend bool operator==(const Flips&, const Flips&) = default;
};

/// The distance by which a datagram leaves later than its turn: after this number of later
/// datagrams, or by this time.
struct Displacement {
    std::uint32_t places = 0;
    base::Duration time{};

    friend bool operator==(const Displacement&, const Displacement&) = default;
};

/// The state in which a law of loss judged a datagram.
enum class LossState : std::uint8_t {
    none, // the law has no states
    good,
    bad,
    received_in_gap, // this and the next three: states of the law four_state
    received_in_burst,
    lost_in_burst,
    lost_in_gap,
};
constexpr auto names_of(base::Tag<LossState>)
{
    return base::names("none", "good", "bad", "received_in_gap", "received_in_burst",
                       "lost_in_burst", "lost_in_gap");
}
[[nodiscard]] constexpr std::string_view to_text(LossState state) { return base::name_of(state); }

/// The most laws of loss that one direction may have.
inline constexpr std::size_t loss_laws_max = 8;

/// The fate of a datagram: delivered, or dropped for a cause. It is a pure function of the seed,
/// the direction, the conditions and the numbers of the datagrams, and for laws that depend on time
/// also of the arrivals. The effects of the queues are not part of it. A datagram that all laws
/// deliver is still dropped while the other side is unknown: no_destination.
struct Fate {
    std::optional<DropCause> drop{}; // nullopt: the datagram is delivered
    std::uint8_t regime = 0;         // regime at its arrival, counted from 1; 0: no regimes
    // Properties of a delivered datagram. A dropped one keeps these defaults.
    base::Duration delay{};                     // without queues and the order policy; >= 0
    std::optional<base::Duration> copy_after{}; // a copy leaves this long after the original
    Flips flips{};
    Displacement displacement{};

    std::array<LossState, loss_laws_max> states{}; // one for each law of loss, in their order

    /// True if the conditions or a replay drop it.
    [[nodiscard]] bool is_lost() const { return drop && *drop != DropCause::no_destination; }

    friend bool operator==(const Fate&, const Fate&) = default;
};

/// Returns the fate of a datagram that has no destination. An earlier cause of a drop stays, and so
/// do the regime and the states of the laws.
[[nodiscard]] inline Fate without_destination(const Fate& fate)
{
    if (fate.drop) return fate;
    return {.drop = DropCause::no_destination, .regime = fate.regime, .states = fate.states};
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/histogram.hpp"
#include "proto/base/time.hpp"
#include "proto/base/value_kind.hpp"

#include <cstdint>

namespace hapnet::emulator {

/// Counts of the datagrams of one direction, by their outcome. At every moment
/// received + duplicated = delivered + dropped_total() + in_flight.
struct Counters {
    std::uint64_t received = 0;
    std::uint64_t delivered = 0;
    std::uint64_t duplicated = 0;
    std::uint64_t corrupted = 0;
    std::uint64_t displaced = 0;
    std::uint64_t reordered = 0;
    std::uint64_t in_flight = 0;
    std::uint64_t ce_in = 0;
    std::uint64_t ce_marked = 0;
    std::uint64_t ce_out = 0;
    std::uint64_t bytes_in = 0;
    std::uint64_t bytes_out = 0;
    base::ByName<DropCause, std::uint64_t> dropped{};

    [[nodiscard]] std::uint64_t dropped_total() const;
};
constexpr auto fields_of(base::Tag<Counters>)
{
    using C = Counters;
    return base::fields(
        "counters",
        base::member("received", &C::received,
                     "Datagrams taken from the end that belongs to this direction.")
            .always_told("received")
            .counter("hapnet_emulator_received"),
        base::member("delivered", &C::delivered,
                     "Datagrams, copies included, that the kernel took for sending.")
            .always_told("delivered")
            .counter("hapnet_emulator_delivered"),
        base::member("duplicated", &C::duplicated, "Copies made.")
            .told("duplicated")
            .counter("hapnet_emulator_duplicated"),
        base::member("corrupted", &C::corrupted, "Datagrams whose bits were flipped.")
            .told("corrupted")
            .counter("hapnet_emulator_corrupted"),
        base::member("displaced", &C::displaced,
                     "Datagrams that `reorder` moved behind later ones.")
            .told("displaced")
            .counter("hapnet_emulator_displaced"),
        base::member("reordered", &C::reordered,
                     "Datagrams, without copies, that left after one with a higher number (RFC "
                     "4737).")
            .told("reordered")
            .counter("hapnet_emulator_reordered"),
        base::member("in_flight", &C::in_flight, "Datagrams that wait to leave.")
            .always_told("in flight")
            .gauge("hapnet_emulator_in_flight"),
        base::member("bytes_in", &C::bytes_in, "Payload of `received`.")
            .counter("hapnet_emulator_received_bytes"),
        base::member("bytes_out", &C::bytes_out, "Payload of `delivered`.")
            .counter("hapnet_emulator_delivered_bytes"),
        base::member("ce_in", &C::ce_in,
                     "Of `received`, those with the mark CE, congestion experienced (RFC 3168), in "
                     "their IP header.")
            .counter("hapnet_emulator_ce_in"),
        base::member("ce_marked", &C::ce_marked, "Datagrams that the queue of a rate marked CE.")
            .counter("hapnet_emulator_ce_marked"),
        base::member("ce_out", &C::ce_out, "Of `delivered`, those with the mark CE.")
            .counter("hapnet_emulator_ce_out"),
        base::member("dropped", &C::dropped, "Datagrams that were dropped, by cause.")
            .told("")
            .counter("hapnet_emulator_dropped", "cause"));
}

/// The counters, and the times that the emulator itself causes.
struct Statistics : Counters {
    base::SnapshotHistogram lateness; // departure minus due time, for each delivered datagram
    base::SnapshotHistogram sojourn;  // wait before a bottleneck, for each datagram that it sent

    /// Adds up the directions of several paths.
    void add(const Statistics& other);

    /// True if the emulator's own timing error is tolerable: 99 % of the datagrams left at most
    /// `budget` late, or nothing left at all.
    [[nodiscard]] bool is_punctual(base::Duration budget) const;

    /// Returns the number of datagrams that left more than `budget` late.
    [[nodiscard]] std::uint64_t late_beyond(base::Duration budget) const;
};

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "proto/base/histogram.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstdint>

namespace hapnet::emulator {

/// What became of the datagrams of one direction. At every moment
/// received + duplicated = delivered + dropped_total() + in_flight.
struct Statistics {
    std::uint64_t received = 0;   // from the endpoint that this direction belongs to
    std::uint64_t delivered = 0;  // handed to the system, which took them
    std::uint64_t duplicated = 0; // extra copies
    std::uint64_t corrupted = 0;
    std::uint64_t reordered = 0; // left after one with a higher number had left (RFC 4737)
    std::uint64_t in_flight = 0; // waiting to leave
    std::uint64_t ce_in = 0;     // of `received`: marked CE (RFC 3168) when it came
    std::uint64_t ce_marked = 0; // marked CE by the law of a queue
    std::uint64_t ce_out = 0;    // of `delivered`: marked CE when it left
    std::uint64_t bytes_in = 0;  // payload of `received`
    std::uint64_t bytes_out = 0; // payload of `delivered`
    std::array<std::uint64_t, drop_causes.size()> dropped{};
    base::SnapshotHistogram lateness; // of each delivered one: left minus due
    base::SnapshotHistogram sojourn;  // before a bottleneck, of each that it sent

    [[nodiscard]] std::uint64_t& dropped_by(DropCause cause);
    [[nodiscard]] std::uint64_t dropped_by(DropCause cause) const;
    [[nodiscard]] std::uint64_t dropped_total() const;

    /// Adds up the directions of several paths.
    void add(const Statistics& other);

    /// Whether the emulator's own timing error is tolerable: 99 % left at most `budget` late, or
    /// nothing left at all.
    [[nodiscard]] bool is_punctual(base::Duration budget) const;

    /// How many left more than `budget` late.
    [[nodiscard]] std::uint64_t late_beyond(base::Duration budget) const;
};

} // namespace hapnet::emulator

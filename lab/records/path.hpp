// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/session.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/figures/arrivals.hpp"
#include "proto/base/figures/quantiles.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::lab::records {

/// The outcome of the state messages of one session in one direction.
struct Path {
    /// The counts of messages. `sent` comes from the sender's record. With more than two peers the
    /// record counts only the messages to the first other peer. For the others, `sent` is the
    /// highest sequence that arrived.
    base::ArrivalCounts arrived;
    /// The share of the sequences up to the highest received one that never arrived, 0 to 1;
    /// nullopt when nothing arrived. Later messages may still have been on their way.
    std::optional<double> loss;
    /// The time from the sender's stamp to the kernel's receive stamp.
    std::optional<base::Quantiles> delay;
    /// |difference of the delays| of messages received one after another (RFC 3393, in the order
    /// of arrival).
    std::optional<base::Quantiles> jitter;
    /// The rate at which the sender sent.
    std::optional<double> packets_per_s;
    /// The number of messages sent after the highest one received. They were on their way at the
    /// end, or lost.
    std::uint64_t in_flight = 0;

    /// Returns the number of messages up to the highest received one that never arrived.
    [[nodiscard]] std::uint64_t lost() const { return arrived.sent - arrived.received - in_flight; }
};

constexpr auto fields_of(base::Tag<Path>)
{
    using Times = std::optional<base::MainQuantiles>;
    return base::fields(
        "path", base::part(&Path::arrived),
        base::member("loss", &Path::loss,
                     "Share that is missing up to the highest sequence received; null when nothing "
                     "was."),
        base::member("packets_per_s", &Path::packets_per_s,
                     "Rate at which the sender sent; null with fewer than two."),
        base::computed<Path>(
            "delay_ms", [](const Path& path) -> Times { return path.delay; },
            "From the sender's stamp to the kernel's receive stamp."),
        base::computed<Path>(
            "jitter_ms", [](const Path& path) -> Times { return path.jitter; },
            "|IPDV| in the order of arrival (RFC 3393)."));
}

/// The two directions of a session.
enum class Way : std::uint8_t { a_to_b, b_to_a };

[[nodiscard]] Path path_of(const Session& session, Way way);

/// A state message of the session that has arrived.
struct ArrivedMessage {
    std::uint32_t sequence = 0;
    base::TimePoint sent{}; // the sender's stamp, on A's clock
    base::Duration delay{};
    bool is_duplicate = false; // true if another copy has arrived before
};

/// Returns the messages in the order of arrival.
[[nodiscard]] std::vector<ArrivedMessage> arrived_messages(const Session& session, Way way);

/// Returns the first sequence that the receiver's record can have.
[[nodiscard]] std::uint32_t first_sequence(const Session& session, Way way,
                                           std::span<const ArrivedMessage> messages);

} // namespace hapnet::lab::records

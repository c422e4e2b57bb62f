// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace hapnet::emulator {

/// Which datagrams the queue before a bottleneck drops while it still has room.
enum class QueueLaw : std::uint8_t { drop_tail, codel, pie };
constexpr auto names_of(base::Tag<QueueLaw>) { return base::names("drop-tail", "codel", "pie"); }

/// The queue before the bottleneck of a rate: its law, and bounds besides that in bytes. Without a
/// rate it does nothing.
struct QueueControl {
    QueueLaw law = QueueLaw::drop_tail;
    std::optional<base::Duration> target{}; // nullopt: that of the RFC, 5 ms or 15 ms
    base::Duration interval = std::chrono::milliseconds{100};
    std::uint32_t packets_max = 0; // waiting; 0: no such bound
    base::Duration time_max{};     // a datagram that would wait longer is dropped; 0: no such bound

    friend bool operator==(const QueueControl&, const QueueControl&) = default;
};
constexpr auto fields_of(base::Tag<QueueControl>)
{
    return base::fields(
        "queue",
        base::field("law", &QueueControl::law,
                    "drops only what does not fit, or also by CoDel (RFC 8289) or PIE (RFC 8033)")
            .required(),
        base::field("target", &QueueControl::target,
                    "time in the queue that the law aims at; 5ms for CoDel, 15ms for PIE"),
        base::field("interval", &QueueControl::interval,
                    "CoDel: how long that time has to be exceeded before it drops"),
        base::field("packets", &QueueControl::packets_max,
                    "datagrams that wait at most; 0: no such bound"),
        base::field("time", &QueueControl::time_max,
                    "a datagram that would wait longer is dropped; 0: no such bound"));
}

[[nodiscard]] base::Result<void> validate(const QueueControl& queue);

} // namespace hapnet::emulator

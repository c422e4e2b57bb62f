// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/ip_marks.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <cstdint>
#include <optional>

namespace hapnet::emulator {

/// The law by which the queue before a bottleneck drops datagrams while it still has room.
enum class QueueLaw : std::uint8_t { drop_tail, codel, pie, fq_codel };
constexpr auto names_of(base::Tag<QueueLaw>)
{
    return base::names("drop-tail", "codel", "pie", "fq-codel");
}

/// A law's verdict on a datagram.
enum class QueueVerdict : std::uint8_t {
    pass,
    mark, // CE instead of a drop, for ECN-capable datagrams
    drop,
};

/// The queue before the bottleneck of a rate: its law, and its bounds in addition to the one in
/// bytes. Without a rate it has no effect.
struct QueueControl {
    static constexpr std::uint32_t flows_most = 65'536;
    static constexpr std::uint32_t quantum_most = 1U << 30U;

    QueueLaw law = QueueLaw::drop_tail;
    std::optional<base::Duration> target{};   // nullopt: 5 ms, or 15 ms for PIE, as in the RFCs
    std::optional<base::Duration> interval{}; // for codel and fq-codel; nullopt: 100 ms
    std::uint32_t packets_max = 0;            // limit of waiting datagrams; 0: no such bound
    base::Duration time_max{}; // a datagram that would wait longer is dropped; 0: no such bound
    /// True if an ECN-capable datagram is marked where the law would drop it; nullopt: true.
    std::optional<bool> is_marking{};
    /// ECN-capable datagrams that waited longer are marked.
    std::optional<base::Duration> mark_above{};
    std::optional<std::uint32_t> flows{};         // number of queues of fq-codel; nullopt: 1024
    std::optional<std::uint32_t> quantum_bytes{}; // bytes in a flow's turn; nullopt: 1514

    [[nodiscard]] base::Duration codel_interval() const
    {
        return interval.value_or(std::chrono::milliseconds{100});
    }
    [[nodiscard]] bool marks() const { return is_marking.value_or(true); }
    [[nodiscard]] std::uint32_t flow_count() const { return flows.value_or(1024); }
    [[nodiscard]] std::uint32_t turn_bytes() const { return quantum_bytes.value_or(1514); }

    friend bool operator==(const QueueControl&, const QueueControl&) = default;
};
constexpr auto fields_of(base::Tag<QueueControl>)
{
    return base::fields(
        "queue",
        base::field(
            "law", &QueueControl::law,
            "drops only what does not fit, or also by CoDel (RFC 8289) or PIE (RFC 8033), or "
            "gives each flow its turn and a CoDel (RFC 8290)")
            .required(),
        base::field(
            "target", &QueueControl::target,
            "time in the queue that the law aims at; 5ms for CoDel and fq-codel, 15ms for PIE"),
        base::field("interval", &QueueControl::interval,
                    "CoDel and fq-codel: how long that time has to be exceeded before they drop; "
                    "100ms unless given"),
        base::field("packets", &QueueControl::packets_max,
                    "datagrams that wait at most; 0: no such bound"),
        base::field("time", &QueueControl::time_max,
                    "a datagram that would wait longer is dropped; 0: no such bound"),
        base::field("ecn", &QueueControl::is_marking,
                    "whether codel, fq-codel or pie marks ECN-capable datagrams (CE) instead of "
                    "dropping them; true unless given"),
        base::field("ecn_threshold", &QueueControl::mark_above,
                    "ECN-capable datagrams that have waited longer are marked CE, under any law"),
        base::field(
            "flows", &QueueControl::flows, base::Count{1, QueueControl::flows_most},
            "fq-codel: number of queues, which a hash of the flow chooses from; 1024 unless given"),
        base::field("quantum", &QueueControl::quantum_bytes,
                    base::Count{1, QueueControl::quantum_most},
                    "fq-codel: bytes that a flow sends before it is the turn of the next; 1514 "
                    "unless given"));
}

[[nodiscard]] base::Result<void> validate(const QueueControl& queue);

/// Returns the verdict of a law, changed to a mark if the law lets an ECN-capable datagram pass
/// that has waited longer than `mark_above` (RFC 9331 and Linux's ce_threshold; equal for ECT(0)
/// and ECT(1)).
[[nodiscard]] inline QueueVerdict with_threshold(QueueVerdict verdict, const QueueControl& control,
                                                 base::Duration waited, base::IpMarks marks)
{
    const bool is_above = control.mark_above && waited > *control.mark_above;
    const bool is_hit = verdict == QueueVerdict::pass && is_above && marks.is_ecn_capable();
    return is_hit ? QueueVerdict::mark : verdict;
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/path.hpp"

#include "lab/records/message_view.hpp"
#include "proto/base/figures/delay_meter.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_set>

namespace hapnet::lab::records {

namespace {

struct Sent {
    std::uint32_t highest = 0;
    std::optional<double> packets_per_s;
};

Sent sent_by(const Side& sender)
{
    Sent sent;
    std::uint64_t count = 0;
    base::TimePoint first{};
    base::TimePoint last{};
    for (const record::TickRow& row : sender.ticks) {
        if (row.sent_sequence == 0) continue;
        if (sender.numbers_sent) sent.highest = std::max(sent.highest, row.sent_sequence);
        last = row.due + row.late;
        if (count++ == 0) first = last;
    }
    if (last > first) {
        sent.packets_per_s = static_cast<double>(count - 1) / base::to_seconds(last - first);
    }
    return sent;
}

/// `delay(received, sent)`: between two times on the two clocks.
Path path_between(const Side& sender, const Side& receiver, const auto& delay)
{
    base::ArrivalCounter arrivals{1};
    std::unordered_set<std::uint32_t> seen;
    std::optional<std::uint32_t> first; // that the record can have
    base::DelayMeter<base::DurationSample> meter;
    for (const record::MessageRow& row : receiver.messages) {
        const auto message = view_of(row);
        if (!message || message->session != receiver.terms.session) continue;
        const bool is_duplicate = !seen.insert(message->sequence).second;
        arrivals.add(message->sequence, is_duplicate);
        if (is_duplicate) continue;
        first = std::min(first.value_or(message->sequence), message->sequence);
        meter.add(delay(row.received_at, message->sent));
    }
    const Sent sent = sent_by(sender);
    Path path{.arrived = arrivals.counts(),
              .loss = {},
              .delay = meter.delays().quantiles(),
              .jitter = meter.variations().quantiles(),
              .packets_per_s = sent.packets_per_s};
    const std::uint64_t highest = path.arrived.sent;
    const std::uint64_t before = receiver.begins_late && first ? *first - 1 : 0;
    // What came was sent, even if the sender was killed before it wrote that down.
    path.arrived.sent = std::max<std::uint64_t>(sent.highest, highest) - before;
    if (highest > 0) {
        path.loss = 1.0 - static_cast<double>(path.arrived.received) /
                              static_cast<double>(highest - before);
    }
    return path;
}

} // namespace

Path path_a_to_b(const Session& session)
{
    return path_between(session.a, session.b, [&](base::TimePoint received, base::TimePoint sent) {
        return session.clock.to_a(received) - sent;
    });
}

Path path_b_to_a(const Session& session)
{
    return path_between(session.b, session.a, [&](base::TimePoint received, base::TimePoint sent) {
        return received - session.clock.to_a(sent);
    });
}

} // namespace hapnet::lab::records

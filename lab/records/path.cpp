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

const Side& sender_of(const Session& session, Way way)
{
    return way == Way::a_to_b ? session.a : session.b;
}

const Side& receiver_of(const Session& session, Way way)
{
    return way == Way::a_to_b ? session.b : session.a;
}

} // namespace

std::vector<ArrivedMessage> arrived_messages(const Session& session, Way way)
{
    const Side& receiver = receiver_of(session, way);
    std::unordered_set<std::uint32_t> seen;
    std::vector<ArrivedMessage> arrived;
    for (const record::MessageRow& row : receiver.messages) {
        const auto message = view_of(row);
        if (!message || message->session != receiver.terms.session) continue;
        const bool is_from_a = way == Way::a_to_b;
        const auto sent = is_from_a ? message->sent : session.clock.to_a(message->sent);
        const auto received = is_from_a ? session.clock.to_a(row.received_at) : row.received_at;
        const bool is_duplicate = !seen.insert(message->sequence).second;
        arrived.push_back({message->sequence, sent, received - sent, is_duplicate});
    }
    return arrived;
}

std::uint32_t first_sequence(const Session& session, Way way,
                             std::span<const ArrivedMessage> messages)
{
    if (!receiver_of(session, way).begins_late || messages.empty()) return 1;
    return std::ranges::min(messages, {}, &ArrivedMessage::sequence).sequence;
}

Path path_of(const Session& session, Way way)
{
    const auto messages = arrived_messages(session, way);
    base::ArrivalCounter arrivals{1};
    base::DelayMeter<base::DurationSample> meter;
    for (const ArrivedMessage& message : messages) {
        arrivals.add(message.sequence, message.is_duplicate);
        if (!message.is_duplicate) meter.add(message.delay);
    }
    const Sent sent = sent_by(sender_of(session, way));
    Path path{.arrived = arrivals.counts(),
              .loss = {},
              .delay = meter.delays().quantiles(),
              .jitter = meter.variations().quantiles(),
              .packets_per_s = sent.packets_per_s,
              .in_flight = 0};
    const std::uint64_t highest = path.arrived.sent;
    const std::uint64_t before = first_sequence(session, way, messages) - 1;
    // A message that arrived was sent, even if the sender was killed before it wrote that down.
    path.arrived.sent = std::max<std::uint64_t>(sent.highest, highest) - before;
    path.in_flight = path.arrived.sent - (highest - std::min(highest, before));
    if (highest > 0) {
        path.loss = 1.0 - static_cast<double>(path.arrived.received) /
                              static_cast<double>(highest - before);
    }
    return path;
}

} // namespace hapnet::lab::records

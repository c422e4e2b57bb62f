// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/path.hpp"

#include "lab/records/message_view.hpp"

#include <algorithm>
#include <cstddef>
#include <unordered_set>
#include <vector>

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
    Path path;
    std::uint32_t highest = 0;
    std::optional<std::uint32_t> first; // that the record can have
    std::unordered_set<std::uint32_t> seen;
    std::vector<base::Duration> delays;
    for (const record::MessageRow& row : receiver.messages) {
        const auto message = view_of(row);
        if (!message || message->session != receiver.terms.session) continue;
        if (!seen.insert(message->sequence).second) {
            ++path.duplicates;
            continue;
        }
        if (message->sequence < highest) ++path.reordered;
        highest = std::max(highest, message->sequence);
        first = std::min(first.value_or(message->sequence), message->sequence);
        delays.push_back(delay(row.received_at, message->sent));
    }
    std::vector<base::Duration> variations;
    for (std::size_t i = 1; i < delays.size(); ++i) {
        variations.push_back(std::chrono::abs(delays[i] - delays[i - 1]));
    }
    const Sent sent = sent_by(sender);
    // What came was sent, even if the sender was killed before it wrote that down.
    const std::uint32_t before = receiver.begins_late && first ? *first - 1 : 0;
    path.sent = std::max(sent.highest, highest) - before;
    path.packets_per_s = sent.packets_per_s;
    path.received = delays.size();
    if (highest > 0) {
        path.loss =
            1.0 - static_cast<double>(path.received) / static_cast<double>(highest - before);
    }
    path.delay = metrics::quantiles_of(std::move(delays));
    path.jitter = metrics::quantiles_of(std::move(variations));
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

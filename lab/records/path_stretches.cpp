// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/path_stretches.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

namespace hapnet::lab::records {

namespace {

using namespace std::chrono_literals;

constexpr std::int64_t stretches_max = 100;
constexpr std::size_t messages_min = 50; // messages of a stretch, on average

double in_ms(base::Duration duration) { return 1e3 * base::to_seconds(duration); }

/// Messages without duplicates, by their sequence.
using Messages = std::vector<ArrivedMessage>;

Messages messages_of(const Session& session, Way way)
{
    Messages messages = arrived_messages(session, way);
    std::erase_if(messages, [](const ArrivedMessage& one) {
        return one.is_duplicate || one.sequence == 0; // no peer sends sequence 0
    });
    std::ranges::stable_sort(messages, {}, &ArrivedMessage::sequence);
    return messages;
}

/// Returns the smallest of 1, 2 and 5 times powers of ten seconds that is not below `least`.
base::Duration round_stretch(base::Duration least)
{
    for (base::Duration power = 100ms;; power *= 10) {
        for (const int factor : {1, 2, 5})
            if (factor * power >= least) return factor * power;
    }
}

base::Duration stretch_of(base::Duration length, std::initializer_list<std::size_t> counts)
{
    base::Duration least = (length + base::Duration{stretches_max - 1}) / stretches_max;
    for (const std::size_t count : counts) {
        if (count <= messages_min) continue; // too few for any stretch
        const double share = static_cast<double>(messages_min) / static_cast<double>(count);
        least = std::max(least, base::from_seconds(share * base::to_seconds(length)));
    }
    return round_stretch(least);
}

/// Sorts the messages of one direction into stretches by the times at which they were sent, since
/// the session's start.
class Stretches {
public:
    Stretches(base::Duration stretch, base::Duration length) : stretch_{stretch}
    {
        for (base::Duration from{0}; from < length; from += stretch)
            path_.stretches.push_back({.from_s = base::to_seconds(from),
                                       .to_s = base::to_seconds(std::min(from + stretch, length))});
        delays_.resize(path_.stretches.size());
    }

    void add_arrived(base::Duration sent, base::Duration delay)
    {
        const auto place = place_of(sent);
        if (sent < base::Duration{0} || place >= delays_.size()) return;
        ++path_.stretches[place].sent;
        ++path_.stretches[place].received;
        delays_[place].add(delay);
    }

    /// Adds `count` lost messages that were sent evenly between two times.
    void add_lost(std::uint64_t count, base::Duration from, base::Duration to)
    {
        if (count == 0) return;
        const auto all = static_cast<double>(count);
        const double span = std::max(base::to_nanoseconds(to - from), 1.0);
        const auto sent_before = [&](std::size_t place) {
            constexpr double rounding = 1e-9;
            const auto at = static_cast<std::int64_t>(place) * stretch_;
            const double passed = base::to_nanoseconds(at - from) / span * (all + 1.0);
            return static_cast<std::uint64_t>(
                std::clamp(std::ceil(passed - rounding) - 1.0, 0.0, all));
        };
        const std::size_t last = std::min(place_of(std::max(from, to)) + 1, delays_.size());
        for (std::size_t place = place_of(from); place < last; ++place)
            path_.stretches[place].sent += sent_before(place + 1) - sent_before(place);
    }

    PathOverTime result() &&
    {
        for (std::size_t place = 0; place < delays_.size(); ++place) {
            const auto& values = delays_[place].values();
            if (values.empty()) continue;
            const auto quantiles = delays_[place].quantiles();
            path_.stretches[place].delay_ms = DelaySpan{
                in_ms(std::ranges::min(values)), in_ms(quantiles->p50), in_ms(quantiles->max)};
            for (const base::Duration delay : values) path_.delays_ms.push_back(in_ms(delay));
        }
        auto& stretches = path_.stretches;
        while (!stretches.empty() && stretches.back().sent == 0) stretches.pop_back();
        return std::move(path_);
    }

private:
    /// Returns the place of a time. A time before the start has the first place.
    [[nodiscard]] std::size_t place_of(base::Duration sent) const
    {
        return static_cast<std::size_t>(std::max(sent, base::Duration{0}) / stretch_);
    }

    base::Duration stretch_;
    PathOverTime path_;
    std::vector<base::DurationSample> delays_; // delays in each stretch
};

/// Returns when the first message of the session was sent, by the sender's record; nullopt: the
/// record does not say.
std::optional<base::TimePoint> first_sent(const Session& session, Way way)
{
    const Side& sender = way == Way::a_to_b ? session.a : session.b;
    if (!sender.numbers_sent) return std::nullopt;
    const auto first = std::ranges::find_if(
        sender.ticks, [](const record::TickRow& row) { return row.sent_sequence == 1; });
    if (first == sender.ticks.end()) return std::nullopt;
    return way == Way::a_to_b ? first->at() : session.clock.to_a(first->at());
}

PathOverTime over_time(const Session& session, Way way, const Messages& messages,
                       base::Duration stretch)
{
    const base::TimePoint start = session.a.terms.start;
    Stretches stretches{stretch, session.a.terms.length};
    if (messages.empty()) return std::move(stretches).result();
    const std::uint32_t first = first_sequence(session, way, messages);
    if (const std::uint32_t lost = messages.front().sequence - first; lost > 0) {
        const base::Duration to = messages.front().sent - start;
        const auto sent = first_sent(session, way).value_or(messages.front().sent) - start;
        stretches.add_lost(lost, sent - (to - sent) / lost, to);
    }
    std::uint32_t before = messages.front().sequence;
    base::Duration sent_before = messages.front().sent - start;
    for (const ArrivedMessage& message : messages) {
        const base::Duration sent = message.sent - start;
        if (message.sequence > before + 1)
            stretches.add_lost(message.sequence - before - 1, sent_before, sent);
        stretches.add_arrived(sent, message.delay);
        before = message.sequence;
        sent_before = sent;
    }
    return std::move(stretches).result();
}

} // namespace

PathsOverTime paths_over_time(const Session& session)
{
    const Messages to_b = messages_of(session, Way::a_to_b);
    const Messages to_a = messages_of(session, Way::b_to_a);
    const base::Duration stretch = stretch_of(session.a.terms.length, {to_b.size(), to_a.size()});
    return {base::to_seconds(stretch), over_time(session, Way::a_to_b, to_b, stretch),
            over_time(session, Way::b_to_a, to_a, stretch)};
}

} // namespace hapnet::lab::records

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/link.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::emulator {

Link::Link(Pipeline pipeline, Order order, QueueLimits limits)
    : pipeline_{std::move(pipeline)}, order_{order}, line_{limits}, buffers_{limits.datagrams_max}
{}

Verdict Link::on_packet(std::span<const std::byte> bytes, base::TimePoint arrival)
{
    Verdict verdict = pipeline_.on_packet(statistics_.received);
    if (std::holds_alternative<Deliver>(verdict) && !line_.has_room(bytes.size())) {
        verdict = Drop{DropCause::queue_full};
    }
    if (const auto* drop = std::get_if<Drop>(&verdict)) {
        ++statistics_.dropped_by(drop->cause);
    } else {
        enqueue(bytes, arrival, std::get<Deliver>(verdict).after);
    }
    ++statistics_.received;
    statistics_.bytes_in += bytes.size();
    return verdict;
}

void Link::enqueue(std::span<const std::byte> bytes, base::TimePoint arrival, base::Duration after)
{
    base::TimePoint due = arrival + after;
    if (order_ == Order::keep) due = std::max(due, last_due_);
    last_due_ = due;
    line_.push({buffers_.copy_of(bytes), statistics_.received, arrival, due});
    ++statistics_.in_flight;
}

std::optional<Datagram> Link::poll(base::TimePoint now) { return line_.pop(now); }

void Link::on_sent(Datagram&& datagram, base::TimePoint at)
{
    --statistics_.in_flight;
    ++statistics_.delivered;
    statistics_.bytes_out += datagram.bytes.size();
    statistics_.lateness.add(at - datagram.due);
    if (datagram.number < beyond_highest_delivered_) {
        ++statistics_.reordered;
    } else {
        beyond_highest_delivered_ = datagram.number + 1;
    }
    buffers_.give_back(std::move(datagram.bytes));
}

void Link::on_failed(Datagram&& datagram, DropCause cause)
{
    --statistics_.in_flight;
    ++statistics_.dropped_by(cause);
    buffers_.give_back(std::move(datagram.bytes));
}

} // namespace hapnet::emulator

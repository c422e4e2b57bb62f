// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay_line.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::emulator {

namespace {

/// The order of a heap whose front leaves first.
bool leaves_after(const Datagram& a, const Datagram& b)
{
    return a.due != b.due ? a.due > b.due : a.number > b.number;
}

} // namespace

DelayLine::DelayLine(QueueLimits limits) : limits_{limits} { heap_.reserve(limits.datagrams_max); }

bool DelayLine::has_room(std::size_t bytes) const
{
    return heap_.size() < limits_.datagrams_max && bytes <= limits_.bytes_max - bytes_;
}

void DelayLine::push(Datagram datagram)
{
    base::ensure(has_room(datagram.bytes.size()));
    bytes_ += datagram.bytes.size();
    heap_.push_back(std::move(datagram));
    std::push_heap(heap_.begin(), heap_.end(), leaves_after);
}

std::optional<Datagram> DelayLine::pop(base::TimePoint now)
{
    if (!base::is_due(next_due(), now)) return std::nullopt;
    std::pop_heap(heap_.begin(), heap_.end(), leaves_after);
    std::optional<Datagram> datagram{std::move(heap_.back())};
    heap_.pop_back();
    bytes_ -= datagram->bytes.size();
    return datagram;
}

std::optional<base::TimePoint> DelayLine::next_due() const
{
    if (heap_.empty()) return std::nullopt;
    return heap_.front().due;
}

} // namespace hapnet::emulator

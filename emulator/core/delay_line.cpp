// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay_line.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <functional>

namespace hapnet::emulator {

DelayLine::DelayLine(std::size_t datagrams_max)
    : datagrams_max_{datagrams_max}, in_turn_{datagrams_max}, sorted_{datagrams_max}
{
    heap_.reserve(datagrams_max);
    times_.reserve(datagrams_max);
}

bool DelayLine::leaves_after(const HeapEntry& a, const HeapEntry& b)
{
    return a.datagram.due != b.datagram.due ? a.datagram.due > b.datagram.due : a.rank > b.rank;
}

void DelayLine::push(const Datagram& datagram)
{
    base::ensure(!is_full());
    if (in_turn_.empty() || in_turn_.back().due <= datagram.due) {
        in_turn_.push(datagram);
        return;
    }
    heap_.push_back({datagram, pushed_++});
    std::push_heap(heap_.begin(), heap_.end(), leaves_after);
}

void DelayLine::push_sorted(const Datagram& datagram)
{
    base::ensure(!is_full());
    sorted_.push(datagram);
    times_.push_back(datagram.due);
    std::push_heap(times_.begin(), times_.end(), std::greater<>{});
}

Datagram DelayLine::pop_sorted()
{
    std::pop_heap(times_.begin(), times_.end(), std::greater<>{});
    Datagram datagram = sorted_.pop();
    datagram.due = times_.back();
    times_.pop_back();
    return datagram;
}

std::optional<Datagram> DelayLine::pop_earliest(base::TimePoint now)
{
    const auto due = earliest_due();
    if (!base::is_due(due, now)) return std::nullopt;
    if (!times_.empty() && times_.front() == *due) return pop_sorted();
    // Among equal times the datagrams in turn were pushed first. A datagram goes to the heap when
    // it is due before the last one in turn. Those that come in turn later are due no earlier than
    // that last one, which is still there.
    if (heap_.empty() || (!in_turn_.empty() && in_turn_.front().due == *due)) return in_turn_.pop();
    std::pop_heap(heap_.begin(), heap_.end(), leaves_after);
    const Datagram datagram = heap_.back().datagram;
    heap_.pop_back();
    return datagram;
}

std::optional<base::TimePoint> DelayLine::earliest_due() const
{
    std::optional<base::TimePoint> due;
    if (!in_turn_.empty()) due = in_turn_.front().due;
    if (!heap_.empty()) due = base::earlier(due, heap_.front().datagram.due);
    if (!times_.empty()) due = base::earlier(due, times_.front());
    return due;
}

} // namespace hapnet::emulator

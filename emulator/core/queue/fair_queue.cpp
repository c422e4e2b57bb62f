// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/queue/fair_queue.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace hapnet::emulator {

namespace {

base::Duration target_of(const QueueControl& control)
{
    return control.target.value_or(std::chrono::milliseconds{5});
}

} // namespace

FairQueue::FairQueue(const QueueControl& control)
    : control_{control},
      flows_(control.flow_count(), Flow{Codel{target_of(control), control.codel_interval()}})
{}

void FairQueue::change(const QueueControl& control)
{
    control_ = control;
    for (Flow& flow : flows_) flow.codel.change(target_of(control), control.codel_interval());
}

void FairQueue::append(Turns& turns, std::uint32_t flow)
{
    flows_[flow].next_in_turn = none;
    flows_[flow].has_turns = true;
    if (turns.first == none) {
        turns.first = flow;
    } else {
        flows_[turns.last].next_in_turn = flow;
    }
    turns.last = flow;
}

void FairQueue::remove_first(Turns& turns)
{
    Flow& flow = flows_[turns.first];
    turns.first = flow.next_in_turn;
    if (turns.first == none) turns.last = none;
    flow.has_turns = false;
}

void FairQueue::push(const Queued& entry, std::uint32_t flow_hash)
{
    std::uint32_t place = free_;
    if (place != none) {
        free_ = nodes_[place].next;
        nodes_[place] = {entry, none};
    } else {
        place = static_cast<std::uint32_t>(nodes_.size());
        nodes_.push_back({entry, none});
    }
    const auto number = static_cast<std::uint32_t>(flow_hash % flows_.size());
    Flow& flow = flows_[number];
    if (flow.first == none) {
        flow.first = place;
    } else {
        nodes_[flow.last].next = place;
    }
    flow.last = place;
    flow.bytes += entry.line_bytes;
    ++size_;
    if (flow.has_turns) return;
    flow.deficit = control_.turn_bytes();
    append(new_, number);
}

Queued FairQueue::take_first(Flow& flow)
{
    const std::uint32_t place = flow.first;
    Node& node = nodes_[place];
    flow.first = node.next;
    if (flow.first == none) flow.last = none;
    flow.bytes -= node.entry.line_bytes;
    --size_;
    node.next = std::exchange(free_, place);
    return node.entry;
}

/// Handles an empty flow. An old one is removed. A new one moves once to the old ones, so that it
/// cannot come back as a new one and keep them waiting (section 4.2).
void FairQueue::visit_empty(Turns& turns, base::TimePoint now)
{
    const std::uint32_t number = turns.first;
    flows_[number].codel.on_empty(now);
    remove_first(turns);
    if (&turns == &new_) append(old_, number);
}

Queued FairQueue::judged(Flow& flow, base::TimePoint now)
{
    const bool is_first = !dropping_from_.has_value();
    Queued entry = take_first(flow);
    const base::Duration waited = now - entry.datagram.arrival;
    const base::IpMarks marks = entry.datagram.marks;
    auto verdict = flow.codel.judge({.waited = waited,
                                     .bytes_behind = flow.bytes,
                                     .is_first = is_first,
                                     .is_markable = control_.marks() && marks.is_ecn_capable()},
                                    now);
    verdict = with_threshold(verdict, control_, waited, marks);
    entry.is_marked = entry.is_marked || verdict == QueueVerdict::mark;
    if (verdict == QueueVerdict::drop) entry.dropped = DropCause::rate_queue_law;
    return entry;
}

Queued FairQueue::next(base::TimePoint now)
{
    base::ensure(!empty());
    for (;;) {
        Turns& turns = new_.first != none ? new_ : old_;
        if (dropping_from_) {
            // The CoDel of the flow whose head was just dropped continues, whichever flow is first
            // in turn at this moment.
            Flow& flow = flows_[*dropping_from_];
            if (flow.first == none) {
                flow.codel.on_empty(now);
                dropping_from_.reset();
                continue;
            }
            const Queued entry = judged(flow, now);
            if (entry.dropped) return entry;
            flow.deficit -= static_cast<std::int64_t>(entry.line_bytes);
            dropping_from_.reset();
            return entry;
        }
        const std::uint32_t number = turns.first;
        Flow& flow = flows_[number];
        if (flow.deficit <= 0) {
            flow.deficit += control_.turn_bytes();
            remove_first(turns);
            append(old_, number);
        } else if (flow.first == none) {
            visit_empty(turns, now);
        } else {
            const Queued entry = judged(flow, now);
            if (entry.dropped) {
                dropping_from_ = number;
            } else {
                flow.deficit -= static_cast<std::int64_t>(entry.line_bytes);
            }
            return entry;
        }
    }
}

void FairQueue::on_empty(base::TimePoint now)
{
    dropping_from_.reset();
    while (new_.first != none) visit_empty(new_, now);
    while (old_.first != none) visit_empty(old_, now);
}

std::vector<Queued> FairQueue::take_from_longest()
{
    constexpr std::size_t taken_max = 64;
    base::ensure(!empty());
    Flow& longest = *std::ranges::max_element(flows_, {}, &Flow::bytes);
    const std::size_t half = longest.bytes / 2;
    std::size_t bytes = 0;
    std::vector<Queued> taken;
    do {
        taken.push_back(take_first(longest));
        bytes += taken.back().line_bytes;
    } while (taken.size() < taken_max && bytes < half);
    return taken;
}

std::vector<Queued> FairQueue::take_all()
{
    std::vector<Queued> all;
    for (Flow& flow : flows_) {
        while (flow.first != none) all.push_back(take_first(flow));
    }
    std::ranges::sort(all, {}, [](const Queued& one) { return one.datagram.number; });
    return all;
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/datagram.hpp"
#include "emulator/core/queue/codel.hpp"
#include "emulator/core/queue/control.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

namespace hapnet::emulator {

/// The queues of FQ-CoDel (RFC 8290, section 4): one for each flow, each with a CoDel of its own.
/// They take turns by deficit round robin; a new flow comes before those that have been sending.
/// Each time the line is free, call next(), and again as long as the returned datagram is dropped.
class FairQueue {
public:
    explicit FairQueue(const QueueControl& control);

    /// Changes the settings. The number of flows must stay the same.
    void change(const QueueControl& control);

    /// Adds a datagram. Flows whose hashes agree by chance share a queue.
    void push(const Queued& entry, std::uint32_t flow_hash);

    /// Takes out the datagram that is sent at `now`, or that CoDel drops (`dropped` is then set).
    /// Ensures that there is one.
    [[nodiscard]] Queued next(base::TimePoint now);

    /// Tells the queue that the line is free and no datagram waits.
    void on_empty(base::TimePoint now);

    /// Takes out the first half of the longest queue, at most 64 datagrams, to be dropped (section
    /// 4.1). Ensures that it is not empty.
    [[nodiscard]] std::vector<Queued> take_from_longest();

    /// Takes out all datagrams, in order of arrival.
    [[nodiscard]] std::vector<Queued> take_all();

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] std::size_t flows() const { return flows_.size(); }
    [[nodiscard]] bool empty() const { return size_ == 0; }

private:
    static constexpr auto none = std::numeric_limits<std::uint32_t>::max();

    struct Node {
        Queued entry;
        std::uint32_t next = none;
    };
    struct Flow {
        explicit Flow(const Codel& its_codel) : codel{its_codel} {}

        Codel codel;
        std::uint32_t first = none; // index in nodes_, as is `last`
        std::uint32_t last = none;
        std::size_t bytes = 0;
        std::int64_t deficit = 0;
        std::uint32_t next_in_turn = none; // index in flows_
        bool has_turns = false;            // the flow is in new_ or old_
    };
    /// A list of flows that take turns.
    struct Turns {
        std::uint32_t first = none;
        std::uint32_t last = none;
    };

    void append(Turns& turns, std::uint32_t flow);
    void remove_first(Turns& turns);
    [[nodiscard]] Queued take_first(Flow& flow);
    void visit_empty(Turns& turns, base::TimePoint now);
    [[nodiscard]] Queued judged(Flow& flow, base::TimePoint now);

    QueueControl control_;
    std::vector<Flow> flows_;
    std::deque<Node> nodes_; // nodes used at least once; they never move
    std::uint32_t free_ = none;
    Turns new_;
    Turns old_;
    std::size_t size_ = 0;
    std::optional<std::uint32_t> dropping_from_; // the flow whose head was just dropped
};

} // namespace hapnet::emulator

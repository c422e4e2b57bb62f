// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/flow/flow.hpp"
#include "emulator/core/flow/packet_facts.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hapnet::emulator {

/// The filters of all flows, prepared for lookups. For each value of a fact, a table has the set of
/// flows that accept it, with one bit for each flow, so that a lookup costs the same for one flow
/// and for sixteen (bit vectors: Lakshman and Stiliadis, SIGCOMM 1998). Several paths share the
/// filters.
class FlowFilters {
public:
    /// `matches` has at most flows_max elements, all valid.
    explicit FlowFilters(std::span<const Match> matches);

    /// Returns the first flow that accepts such a packet, counted from 0; nullopt: no flow does.
    [[nodiscard]] std::optional<std::size_t> first(const PacketFacts& facts) const;

private:
    using Flows = std::uint16_t; // one bit for each flow

    /// The set of flows that accept each number. An empty table: all flows accept all numbers.
    class Table {
    public:
        /// `range_of(match)` returns the range that a match requires; nullopt: the match has no
        /// requirement.
        Table(std::span<const Match> matches, std::size_t numbers, const auto& range_of);

        [[nodiscard]] Flows at(std::size_t number) const
        {
            return flows_.empty() ? Flows{0xffff} : flows_[number];
        }

    private:
        std::vector<Flows> flows_;
    };

    std::vector<Match> matches_;
    Table by_protocol_;
    Table by_version_;
    Table by_dscp_;
    Table by_size_;
    Table by_port_; // port of either end
    Table by_to_port_;
    Table by_from_port_;
    Flows all_ = 0;
    Flows with_ports_ = 0; // flows that ask for ports
    Flows with_nets_ = 0;  // flows that ask for addresses
};

/// Determines to which flow each packet of one path belongs. Later fragments of a packet belong to
/// the flow of its first fragment, as long as that is remembered.
class Classifier {
public:
    explicit Classifier(std::shared_ptr<const FlowFilters> filters) : filters_{std::move(filters)}
    {}

    /// Returns the flow of a packet that arrived at `at`; nullopt: it belongs to none.
    [[nodiscard]] std::optional<std::size_t> classify(const PacketFacts& facts, base::TimePoint at)
    {
        if (facts.part != PacketFacts::Part::whole) return classify_fragment(facts, at);
        return filters_->first(facts);
    }

    /// Returns the number of later fragments whose first fragment was not remembered. They were
    /// classified by their own headers, without ports.
    [[nodiscard]] std::uint64_t unknown_fragments() const { return unknown_fragments_; }

    /// The greatest number of fragmented packets that are remembered at one time, and the time for
    /// which each one is remembered (RFC 8200, 4.5).
    static constexpr std::size_t packets_max = 256;
    static constexpr base::Duration remembered_for = std::chrono::seconds{60};

private:
    /// A packet whose first fragment has arrived.
    struct Fragmented {
        Address from{};
        Address to{};
        std::uint32_t id = 0;
        std::uint16_t protocol = 0; // 0 for IPv6, which does not identify fragments by it
        std::uint8_t version = 0;   // 0: this place is free
        std::int8_t flow = -1;      // -1: it belongs to no flow
        base::TimePoint at{};
    };

    std::optional<std::size_t> classify_fragment(const PacketFacts& facts, base::TimePoint at);

    std::shared_ptr<const FlowFilters> filters_;
    std::unique_ptr<std::array<Fragmented, packets_max>> fragmented_; // null: no fragment yet
    std::uint64_t unknown_fragments_ = 0;
};

} // namespace hapnet::emulator

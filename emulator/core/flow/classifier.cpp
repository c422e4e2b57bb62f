// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/classifier.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace hapnet::emulator {

namespace {

constexpr std::size_t words = std::numeric_limits<std::uint16_t>::max() + std::size_t{1};

std::optional<NumberRange> just(const auto& number)
{
    if (!number) return std::nullopt;
    return NumberRange{*number, *number};
}

/// Returns the protocols of a match. A match without a protocol accepts all of IP.
std::optional<NumberRange> protocols_of(const Match& match)
{
    return match.protocol ? just(match.protocol) : NumberRange{0, PacketFacts::arp - 1};
}

bool asks_for_net(const Match& match)
{
    return match.host || match.net || match.to_net || match.from_net;
}

bool asks_for_port(const Match& match)
{
    return match.port || match.ports || match.to_port || match.from_port;
}

/// True if the addresses meet the match.
bool takes_addresses(const Match& match, const PacketFacts& facts)
{
    const auto has = [&](const std::optional<Net>& net, const Address& address) {
        return !net || net->contains(address, facts.version);
    };
    const auto either_has = [&](const std::optional<Net>& net) {
        return has(net, facts.from) || has(net, facts.to);
    };
    return either_has(match.host) && either_has(match.net) && has(match.to_net, facts.to) &&
           has(match.from_net, facts.from);
}

std::size_t place_of_packet(const PacketFacts& facts)
{
    const std::uint64_t mixed =
        (facts.from.low ^ std::rotl(facts.to.low, 16) ^ facts.fragment_id) * 0x9e37'79b9'7f4a'7c15U;
    return mixed >> 56U;
}

} // namespace

FlowFilters::Table::Table(std::span<const Match> matches, std::size_t numbers, const auto& range_of)
{
    const bool is_asked =
        std::ranges::any_of(matches, [&](const Match& one) { return range_of(one).has_value(); });
    if (!is_asked) return;
    flows_.resize(numbers);
    for (std::size_t i = 0; i < matches.size(); ++i) {
        const auto range = range_of(matches[i]).value_or(NumberRange{});
        const std::size_t end = std::min<std::size_t>(range.last + std::size_t{1}, numbers);
        for (std::size_t number = range.first; number < end; ++number) {
            flows_[number] = static_cast<Flows>(flows_[number] | 1U << i);
        }
    }
}

FlowFilters::FlowFilters(std::span<const Match> matches)
    : matches_{matches.begin(), matches.end()},
      by_protocol_{matches, PacketFacts::arp + 1U, protocols_of},
      by_version_{matches, 7, [](const Match& m) { return just(m.ip); }},
      by_dscp_{matches, 64, [](const Match& m) { return just(m.dscp); }},
      by_size_{matches, words, [](const Match& m) { return m.size; }},
      by_port_{matches, words, [](const Match& m) { return m.port ? m.port : m.ports; }},
      by_to_port_{matches, words, [](const Match& m) { return m.to_port; }},
      by_from_port_{matches, words, [](const Match& m) { return m.from_port; }}
{
    base::ensure(matches.size() <= flows_max);
    for (std::size_t i = 0; i < matches.size(); ++i) {
        const auto bit = static_cast<Flows>(1U << i);
        all_ = static_cast<Flows>(all_ | bit);
        if (asks_for_port(matches[i])) with_ports_ = static_cast<Flows>(with_ports_ | bit);
        if (asks_for_net(matches[i])) with_nets_ = static_cast<Flows>(with_nets_ | bit);
    }
}

std::optional<std::size_t> FlowFilters::first(const PacketFacts& facts) const
{
    const auto bytes = std::min<std::size_t>(facts.bytes, words - 1);
    unsigned flows = all_ & by_protocol_.at(facts.protocol) & by_version_.at(facts.version) &
                     by_dscp_.at(facts.dscp) & by_size_.at(bytes);
    if (facts.has_ports) {
        flows &= static_cast<unsigned>(by_port_.at(facts.from_port) | by_port_.at(facts.to_port));
        flows &= static_cast<unsigned>(by_to_port_.at(facts.to_port));
        flows &= static_cast<unsigned>(by_from_port_.at(facts.from_port));
    } else {
        flows &= ~static_cast<unsigned>(with_ports_);
    }
    for (; flows != 0; flows &= flows - 1) {
        const auto flow = static_cast<std::size_t>(std::countr_zero(flows));
        const bool has_nets = (with_nets_ >> flow & 1U) != 0;
        if (!has_nets || takes_addresses(matches_[flow], facts)) return flow;
    }
    return std::nullopt;
}

std::optional<std::size_t> Classifier::classify_fragment(const PacketFacts& facts,
                                                         base::TimePoint at)
{
    if (!fragmented_) fragmented_ = std::make_unique<std::array<Fragmented, packets_max>>();
    const Fragmented packet{.from = facts.from,
                            .to = facts.to,
                            .id = facts.fragment_id,
                            .protocol = facts.version == 4 ? facts.protocol : std::uint16_t{0},
                            .version = facts.version,
                            .at = at};
    Fragmented& place = (*fragmented_)[place_of_packet(facts)];
    if (facts.part == PacketFacts::Part::first) {
        const auto flow = filters_->first(facts);
        place = packet;
        place.flow = flow ? static_cast<std::int8_t>(*flow) : std::int8_t{-1};
        return flow;
    }
    const bool is_known = place.version == packet.version && place.id == packet.id &&
                          place.protocol == packet.protocol && place.from == packet.from &&
                          place.to == packet.to && at - place.at <= remembered_for;
    if (!is_known) {
        ++unknown_fragments_;
        return filters_->first(facts);
    }
    return place.flow < 0 ? std::nullopt : std::optional<std::size_t>{place.flow};
}

} // namespace hapnet::emulator

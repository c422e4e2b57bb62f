// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/packet_facts.hpp"

#include "emulator/core/network_bytes.hpp"

namespace hapnet::emulator {

namespace {

// Numbers of IANA.
constexpr std::uint16_t type_ipv4 = 0x0800;
constexpr std::uint16_t type_arp = 0x0806;
constexpr std::uint16_t type_ipv6 = 0x86dd;
enum HeaderKind : std::uint8_t {
    hop_by_hop = 0,
    tcp = 6,
    udp = 17,
    routing = 43,
    fragment = 44,
    authentication = 51,
    destination = 60,
    sctp = 132,
    mobility = 135,
    udp_lite = 136,
    host_identity = 139,
    shim6 = 140,
};

// Compilers convert this form to one load.
std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t at)
{
    const std::byte* const b = bytes.subspan(at, 4).data();
    return std::to_integer<std::uint32_t>(b[0]) << 24U |
           std::to_integer<std::uint32_t>(b[1]) << 16U |
           std::to_integer<std::uint32_t>(b[2]) << 8U | std::to_integer<std::uint32_t>(b[3]);
}

Address ipv4_at(std::span<const std::byte> packet, std::size_t at)
{
    return {0, Address::ipv4_prefix | word_at(packet, at)};
}

bool carries_ports(std::uint16_t protocol)
{
    return protocol == tcp || protocol == udp || protocol == sctp || protocol == udp_lite;
}

/// Reads the ports at the beginning of `segment`. Returns false if they are truncated.
bool read_ports(std::span<const std::byte> segment, PacketFacts& facts)
{
    if (!carries_ports(facts.protocol) || facts.part == PacketFacts::Part::later) return true;
    if (segment.size() < 4) return false;
    facts.has_ports = true;
    facts.from_port = at16(segment, 0);
    facts.to_port = at16(segment, 2);
    return true;
}

/// Returns the facts about an IPv4 packet (RFC 791).
std::optional<PacketFacts> facts_of_ipv4(std::span<const std::byte> packet)
{
    constexpr std::size_t header_min = 20;
    constexpr unsigned more_fragments = 0x2000;
    constexpr unsigned offset_bits = 0x1fff;
    if (packet.size() < header_min || at8(packet, 0) >> 4 != 4) return std::nullopt;
    const std::size_t header = std::size_t{4} * (at8(packet, 0) & 0xfU);
    const std::size_t total = at16(packet, 2);
    if (header < header_min || header > total || total > packet.size()) return std::nullopt;
    PacketFacts facts{.protocol = at8(packet, 9),
                      .version = 4,
                      .dscp = static_cast<std::uint8_t>(at8(packet, 1) >> 2),
                      .bytes = static_cast<std::uint32_t>(total),
                      .from = ipv4_at(packet, 12),
                      .to = ipv4_at(packet, 16)};
    const unsigned place = at16(packet, 6);
    if ((place & (more_fragments | offset_bits)) != 0) {
        const bool is_first = (place & offset_bits) == 0;
        facts.part = is_first ? PacketFacts::Part::first : PacketFacts::Part::later;
        facts.fragment_id = at16(packet, 4);
    }
    if (!read_ports(packet.subspan(header, total - header), facts)) return std::nullopt;
    return facts;
}

/// Returns the length of the extension header at the beginning of `rest`; nullopt: it is not one.
std::optional<std::size_t> extension_bytes(std::uint16_t kind, std::span<const std::byte> rest)
{
    switch (kind) {
    case hop_by_hop:
    case routing:
    case destination:
    case mobility:
    case host_identity:
    case shim6: return rest.size() < 2 ? 8 : std::size_t{8} * (at8(rest, 1) + 1U);
    case authentication: return rest.size() < 2 ? 8 : std::size_t{4} * (at8(rest, 1) + 2U);
    case fragment: return 8;
    default: return std::nullopt;
    }
}

/// Returns the facts about an IPv6 packet (RFC 8200).
std::optional<PacketFacts> facts_of_ipv6(std::span<const std::byte> packet)
{
    constexpr std::size_t header = 40;
    constexpr int extensions_max = 8;
    if (packet.size() < header || at8(packet, 0) >> 4 != 6) return std::nullopt;
    const std::size_t total = header + at16(packet, 4);
    if (total > packet.size()) return std::nullopt;
    PacketFacts facts{.protocol = at8(packet, 6),
                      .version = 6,
                      .dscp = static_cast<std::uint8_t>(at16(packet, 0) >> 6 & 0x3f),
                      .bytes = static_cast<std::uint32_t>(total),
                      .from = address_of(packet.subspan(8, 16)),
                      .to = address_of(packet.subspan(24, 16))};
    auto rest = packet.subspan(header, total - header);
    for (int i = 0; facts.part != PacketFacts::Part::later; ++i) {
        const auto bytes = extension_bytes(facts.protocol, rest);
        if (!bytes) break;
        if (i == extensions_max || *bytes > rest.size()) return std::nullopt;
        const bool is_fragment = facts.protocol == fragment;
        facts.protocol = at8(rest, 0);
        // No offset and no more fragments: an atomic fragment (RFC 6946) is a whole packet.
        if (const unsigned place = is_fragment ? at16(rest, 2) & 0xfff9U : 0; place != 0) {
            facts.part = place >> 3U == 0 ? PacketFacts::Part::first : PacketFacts::Part::later;
            facts.fragment_id = std::uint32_t{at16(rest, 4)} << 16U | at16(rest, 6);
        }
        rest = rest.subspan(*bytes);
    }
    if (!read_ports(rest, facts)) return std::nullopt;
    return facts;
}

} // namespace

std::optional<PacketFacts> facts_of(const Frame& frame, std::span<const std::byte> bytes)
{
    const std::size_t header = frame.header_bytes;
    if (header < Frame::header_bytes_min) return std::nullopt;
    const auto packet = bytes.subspan(header);
    switch (at16(bytes, header - 2)) {
    case type_ipv4: return facts_of_ipv4(packet);
    case type_ipv6: return facts_of_ipv6(packet);
    case type_arp: return PacketFacts{.protocol = PacketFacts::arp};
    default: return std::nullopt;
    }
}

} // namespace hapnet::emulator

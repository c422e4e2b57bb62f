// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/frame.hpp"

#include "emulator/core/network_bytes.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <optional>

namespace hapnet::emulator {

namespace {

// Numbers of IANA.
enum EtherType : std::uint16_t {
    ether_ipv4 = 0x0800,
    ether_arp = 0x0806,
    ether_vlan = 0x8100,
    ether_ipv6 = 0x86dd,
    ether_service_vlan = 0x88a8,
};
enum IpProtocol : std::uint8_t {
    ip_icmp = 1,
    ip_tcp = 6,
    ip_udp = 17,
    ip_icmpv6 = 58,
};

constexpr std::size_t ether_type_at = 12;
constexpr std::size_t ipv6_header_bytes = 40;
constexpr std::size_t ipv4_header_bytes_min = 20;

/// True for router and neighbour solicitations and advertisements, and redirects (RFC 4861). They
/// are the first header after that of IPv6.
bool is_neighbour_discovery(std::span<const std::byte> packet)
{
    constexpr std::size_t next_header_at = 6;
    constexpr std::uint8_t first = 133;
    constexpr std::uint8_t last = 137;
    if (packet.size() <= ipv6_header_bytes || at8(packet, next_header_at) != ip_icmpv6) {
        return false;
    }
    const auto type = at8(packet, ipv6_header_bytes);
    return type >= first && type <= last;
}

FrameKind kind_of(std::uint16_t type, std::span<const std::byte> packet)
{
    switch (type) {
    case ether_arp: return FrameKind::neighbours;
    case ether_ipv4: return FrameKind::ip;
    case ether_ipv6: return is_neighbour_discovery(packet) ? FrameKind::neighbours : FrameKind::ip;
    default: return FrameKind::other;
    }
}

bool has_ipv4_header(std::uint16_t type, std::span<const std::byte> packet)
{
    return type == ether_ipv4 && packet.size() >= ipv4_header_bytes_min && at8(packet, 0) >> 4 == 4;
}

bool has_ipv6_header(std::uint16_t type, std::span<const std::byte> packet)
{
    return type == ether_ipv6 && packet.size() >= ipv6_header_bytes && at8(packet, 0) >> 4 == 6;
}

base::IpMarks marks_of(std::uint16_t type, std::span<const std::byte> packet)
{
    if (has_ipv4_header(type, packet)) return {at8(packet, 1), at8(packet, 8)};
    if (!has_ipv6_header(type, packet)) return {};
    return {static_cast<std::uint8_t>(at16(packet, 0) >> 4), at8(packet, 7)};
}

/// An incremental hash (FNV-1a).
class FlowHash {
public:
    void add(std::span<const std::byte> bytes)
    {
        for (const std::byte byte : bytes) {
            hash_ = (hash_ ^ std::to_integer<std::uint32_t>(byte)) * 16'777'619U;
        }
    }
    /// Mixes all bits, because only some of them distinguish flows.
    [[nodiscard]] std::uint32_t value() const
    {
        std::uint32_t mixed = hash_ ^ hash_ >> 16;
        mixed *= 0x85eb'ca6bU;
        mixed ^= mixed >> 13;
        mixed *= 0xc2b2'ae35U;
        return mixed ^ mixed >> 16;
    }

private:
    std::uint32_t hash_ = 2'166'136'261U;
};

constexpr unsigned ipv4_offset_and_more = 0x3fff; // nonzero: the packet is a fragment

bool has_ports(std::uint8_t protocol) { return protocol == ip_tcp || protocol == ip_udp; }

/// Returns the sum of 16-bit words whose complement is the checksum of IP and its protocols (RFC
/// 1071).
std::uint64_t sum_of(std::span<const std::byte> bytes)
{
    std::uint64_t sum = 0;
    std::size_t i = 0;
    for (; i + 1 < bytes.size(); i += 2) sum += at16(bytes, i);
    if (i < bytes.size()) sum += static_cast<std::uint64_t>(at8(bytes, i)) << 8;
    return sum;
}

std::uint16_t folded(std::uint64_t sum)
{
    while (sum > 0xffff) sum = (sum & 0xffff) + (sum >> 16);
    return static_cast<std::uint16_t>(~sum & 0xffff);
}

/// The payload after an IP header.
struct Segment {
    std::uint8_t protocol = 0;
    std::span<std::byte> bytes{};
    std::uint64_t pseudo_header = 0; // sum of the words of its addresses
    bool is_v4 = false;
};

void fix_segment(const Segment& segment)
{
    struct Place {
        std::size_t at;
        std::size_t bytes_min;
    };
    const auto place = [&]() -> std::optional<Place> {
        switch (segment.protocol) {
        case ip_tcp: return Place{16, 20};
        case ip_udp: return Place{6, 8};
        case ip_icmp: return segment.is_v4 ? std::optional{Place{2, 4}} : std::nullopt;
        case ip_icmpv6: return segment.is_v4 ? std::nullopt : std::optional{Place{2, 4}};
        default: return std::nullopt;
        }
    }();
    if (!place || segment.bytes.size() < place->bytes_min) return;
    const bool is_udp = segment.protocol == ip_udp;
    if (is_udp && segment.is_v4 && at16(segment.bytes, place->at) == 0) return; // no checksum
    put16(segment.bytes, place->at, 0);
    const bool has_pseudo_header = segment.protocol != ip_icmp;
    const auto checksum = folded(
        sum_of(segment.bytes) +
        (has_pseudo_header ? segment.pseudo_header + segment.protocol + segment.bytes.size() : 0));
    put16(segment.bytes, place->at, is_udp && checksum == 0 ? 0xffff : checksum);
}

void fix_ipv4(std::span<std::byte> packet)
{
    if (packet.size() < ipv4_header_bytes_min || at8(packet, 0) >> 4 != 4) return;
    const std::size_t header = std::size_t{4} * (at8(packet, 0) & 0xfU);
    const std::size_t total = at16(packet, 2);
    if (header < ipv4_header_bytes_min || header > total || total > packet.size()) return;
    put16(packet, 10, 0);
    put16(packet, 10, folded(sum_of(packet.first(header))));
    if ((at16(packet, 6) & ipv4_offset_and_more) != 0) return;
    fix_segment({.protocol = at8(packet, 9),
                 .bytes = packet.subspan(header, total - header),
                 .pseudo_header = sum_of(packet.subspan(12, 8)),
                 .is_v4 = true});
}

/// Fixes the checksum of an IPv6 packet, unless the packet has an extension header.
void fix_ipv6(std::span<std::byte> packet)
{
    if (packet.size() < ipv6_header_bytes || at8(packet, 0) >> 4 != 6) return;
    const std::size_t payload = at16(packet, 4);
    if (ipv6_header_bytes + payload > packet.size()) return;
    fix_segment({.protocol = at8(packet, 6),
                 .bytes = packet.subspan(ipv6_header_bytes, payload),
                 .pseudo_header = sum_of(packet.subspan(8, 32)),
                 .is_v4 = false});
}

} // namespace

Frame read_frame(std::span<const std::byte> bytes)
{
    constexpr int tags_max = 2;
    Frame frame;
    if (bytes.size() < Frame::header_bytes_min) {
        frame.header_bytes = static_cast<std::uint8_t>(bytes.size());
        return frame;
    }
    std::ranges::copy(bytes.subspan(6, 6), frame.source.begin());
    std::size_t at = ether_type_at;
    for (int tags = 0; tags < tags_max; ++tags) {
        const auto type = at16(bytes, at);
        if (type != ether_vlan && type != ether_service_vlan) break;
        if (bytes.size() < at + Frame::vlan_tag_bytes + 2) break;
        at += Frame::vlan_tag_bytes;
    }
    frame.header_bytes = static_cast<std::uint8_t>(at + 2);
    frame.kind = kind_of(at16(bytes, at), bytes.subspan(at + 2));
    frame.marks = marks_of(at16(bytes, at), bytes.subspan(at + 2));
    return frame;
}

std::optional<MacAddress> destination_of(std::span<const std::byte> frame)
{
    MacAddress machine{};
    if (frame.size() < Frame::header_bytes_min) return std::nullopt;
    std::ranges::copy(frame.first(machine.size()), machine.begin());
    const bool is_group = (machine[0] & std::byte{1}) != std::byte{0};
    return is_group ? std::nullopt : std::optional{machine};
}

std::span<const std::byte> ip_packet_of(std::span<const std::byte> frame)
{
    const std::size_t header = read_frame(frame).header_bytes;
    if (header < Frame::header_bytes_min) return {};
    const auto type = at16(frame, header - 2);
    const auto packet = frame.subspan(header);
    std::size_t length = 0;
    if (has_ipv4_header(type, packet)) {
        length = std::max<std::size_t>(at16(packet, 2), ipv4_header_bytes_min);
    } else if (has_ipv6_header(type, packet)) {
        length = ipv6_header_bytes + at16(packet, 4);
    }
    return packet.first(std::min(length, packet.size()));
}

std::uint32_t flow_of(std::span<const std::byte> frame)
{
    const std::size_t header = read_frame(frame).header_bytes;
    if (header < Frame::header_bytes_min) return 0;
    const auto type = at16(frame, header - 2);
    const auto packet = frame.subspan(header);
    FlowHash hash;
    std::size_t ports_at = 0;
    std::size_t protocol_at = 0;
    bool is_fragment = false;
    if (has_ipv4_header(type, packet)) {
        protocol_at = 9;
        ports_at = std::size_t{4} * (at8(packet, 0) & 0xfU);
        is_fragment = (at16(packet, 6) & ipv4_offset_and_more) != 0;
        hash.add(packet.subspan(12, 8));
    } else if (has_ipv6_header(type, packet)) {
        protocol_at = 6;
        ports_at = ipv6_header_bytes;
        hash.add(packet.subspan(8, 32));
    } else {
        return 0;
    }
    hash.add(packet.subspan(protocol_at, 1));
    const bool are_there = has_ports(at8(packet, protocol_at)) && packet.size() >= ports_at + 4;
    if (are_there && !is_fragment) hash.add(packet.subspan(ports_at, 4));
    return hash.value();
}

bool says_port_unreachable(const Frame& frame, std::span<const std::byte> bytes)
{
    if (frame.kind != FrameKind::ip) return false;
    const auto packet = bytes.subspan(frame.header_bytes);
    const auto byte_at = [&](std::size_t at) {
        return at < packet.size() ? std::to_integer<unsigned>(packet[at]) : 0U;
    };
    const auto says = [&](std::size_t at, unsigned type, unsigned code) {
        return byte_at(at) == type && byte_at(at + 1) == code;
    };
    constexpr unsigned icmp = 1;
    constexpr unsigned icmp_v6 = 58;
    if (byte_at(0) >> 4U == 6) return byte_at(6) == icmp_v6 && says(40, 1, 4);
    return byte_at(9) == icmp && says(std::size_t{4} * (byte_at(0) & 0xfU), 3, 3);
}

/// Updates the checksum incrementally (RFC 1624, equation 3).
void mark_congestion(std::span<std::byte> frame)
{
    const std::size_t header = read_frame(frame).header_bytes;
    base::ensure(header >= Frame::header_bytes_min);
    const auto type = at16(frame, header - 2);
    const auto packet = frame.subspan(header);
    const auto before = at16(packet, 0);
    if (has_ipv4_header(type, packet)) {
        const auto after = static_cast<std::uint16_t>(before | 0x0003U);
        put16(packet, 0, after);
        const auto old = static_cast<std::uint16_t>(~at16(packet, 10));
        put16(packet, 10, folded(std::uint64_t{old} + static_cast<std::uint16_t>(~before) + after));
    } else {
        base::ensure(has_ipv6_header(type, packet));
        put16(packet, 0, static_cast<std::uint16_t>(before | 0x0030U));
    }
}

void fix_checksums(std::span<std::byte> frame)
{
    const auto read = read_frame(frame);
    if (read.kind == FrameKind::other || read.header_bytes < Frame::header_bytes_min) return;
    const auto packet = frame.subspan(read.header_bytes);
    const auto type = at16(frame, read.header_bytes - 2U);
    if (type == ether_ipv4) fix_ipv4(packet);
    if (type == ether_ipv6) fix_ipv6(packet);
}

} // namespace hapnet::emulator

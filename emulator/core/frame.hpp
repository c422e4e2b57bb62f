// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ip_marks.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::emulator {

/// The kind of payload of an Ethernet frame.
enum class FrameKind : std::uint8_t {
    ip,         // IPv4 or IPv6, also with VLAN tags
    neighbours, // ARP, or neighbour discovery of ICMPv6
    other,
};

using MacAddress = std::array<std::byte, 6>;

/// The properties of an Ethernet frame, without its checksum, that are needed to pass it on.
struct Frame {
    FrameKind kind = FrameKind::other;
    std::uint8_t header_bytes = 0; // Ethernet header, with VLAN tags
    MacAddress source{};
    base::IpMarks marks{}; // set if it is an IP packet with a whole header

    static constexpr std::size_t header_bytes_min = 14;
    static constexpr std::size_t vlan_tag_bytes = 4;
};

/// Reads any bytes. Bytes that are too short for Ethernet, or that have more than two VLAN tags,
/// are of the kind `other`.
[[nodiscard]] Frame read_frame(std::span<const std::byte> bytes);

/// Returns the destination address of a frame; nullopt: the frame is for a group, or too short for
/// Ethernet.
[[nodiscard]] std::optional<MacAddress> destination_of(std::span<const std::byte> frame);

/// Returns the IP packet that a frame carries, without the padding of a short frame; empty: the
/// frame carries none.
[[nodiscard]] std::span<const std::byte> ip_packet_of(std::span<const std::byte> frame);

/// Returns a hash of addresses, protocol and ports, which tells the flows of IP packets apart.
/// Fragments have no ports, so that all fragments of a packet belong together. Everything that is
/// not IP is one flow.
[[nodiscard]] std::uint32_t flow_of(std::span<const std::byte> frame);

/// True for a frame with the message "port unreachable" of ICMP or ICMPv6 (RFC 792, RFC 4443): no
/// program listens at the destination of a datagram.
[[nodiscard]] bool says_port_unreachable(const Frame& frame, std::span<const std::byte> bytes);

/// Marks the IP packet of a frame as having experienced congestion (RFC 3168), and updates the
/// checksum. Ensures that the frame has marks.
void mark_congestion(std::span<std::byte> frame);

/// Recomputes the checksums of IPv4, TCP, UDP, ICMP and ICMPv6 where the frame has the whole
/// packet: it is no fragment, and no header claims more bytes than there are. A UDP datagram over
/// IPv4 without a checksum stays without.
void fix_checksums(std::span<std::byte> frame);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::emulator {

/// What an Ethernet frame carries.
enum class FrameKind : std::uint8_t {
    ip,         // IPv4 or IPv6, also with VLAN tags
    neighbours, // ARP, or the part of ICMPv6 that takes its place: who is where
    other,
};

using MacAddress = std::array<std::byte, 6>;

/// An Ethernet frame, without its checksum, as far as it has to be known to pass it on.
struct Frame {
    FrameKind kind = FrameKind::other;
    std::uint8_t header_bytes = 0; // Ethernet's, with VLAN tags
    MacAddress source{};

    static constexpr std::size_t header_bytes_min = 14;
    static constexpr std::size_t vlan_tag_bytes = 4;
};

/// Reads any bytes; those that are too short for Ethernet, or that have more than two VLAN tags,
/// are of the kind `other`.
[[nodiscard]] Frame read_frame(std::span<const std::byte> bytes);

/// Computes the checksums of IPv4, TCP, UDP, ICMP and ICMPv6 anew, where the frame has them whole:
/// no fragment, no header that says more bytes than there are. A UDP datagram over IPv4 without a
/// checksum stays without.
void fix_checksums(std::span<std::byte> frame);

} // namespace hapnet::emulator

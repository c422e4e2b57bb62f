// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

/// The sender or the receiver of a packet. An IPv4 address occupies the first four bytes.
struct PacketEnd {
    std::array<std::byte, 16> address{};
    std::uint16_t port = 0; // for an ICMP echo: its identifier, at both ends
    bool is_v6 = false;

    friend auto operator<=>(const PacketEnd&, const PacketEnd&) = default;
};

enum class PacketProtocol : std::uint8_t { udp, tcp, echo };

/// The packets of one protocol from one end to another.
struct PacketFlow {
    PacketProtocol protocol = PacketProtocol::udp;
    PacketEnd from{};
    PacketEnd to{};

    [[nodiscard]] PacketFlow back() const { return {protocol, to, from}; }
    friend auto operator<=>(const PacketFlow&, const PacketFlow&) = default;
};

/// Returns "UDP 10.0.0.1:7000 > 10.0.0.2:7001" or "ping 10.0.0.1 > 10.0.0.2".
[[nodiscard]] std::string to_text(const PacketFlow& flow);

/// A complete IP packet of UDP, of TCP with a payload, or an ICMP echo.
struct SeenPacket {
    base::Duration at{}; // time since 1970
    std::uint32_t interface = 0;
    PacketFlow flow{};
    std::uint32_t number = 0;             // sequence number of TCP or of an echo
    std::span<const std::byte> payload{}; // as much as was captured
    std::size_t payload_bytes = 0;        // payload size on the wire
};

/// The contents of a file of packets.
struct Capture {
    std::vector<SeenPacket> packets; // payloads point into the bytes that were read
    std::size_t passed_over = 0; // packets left out: fragments, other protocols, acknowledgements
    // Number of the packet within which the file ends; 0: the file is whole
    std::size_t cut_off_in = 0;
};

inline constexpr std::size_t captured_packets_max = 2'000'000;

/// True if the bytes begin like a pcap or a pcapng file.
[[nodiscard]] bool is_capture(std::string_view bytes);

/// Reads pcap, with times in microseconds or nanoseconds, or pcapng, of either byte order, whose
/// interfaces are Ethernet (with VLAN tags), raw IP, Linux cooked (1 and 2) or loopback. A
/// truncated packet ends the capture; Capture::cut_off_in has its number. The formats:
/// draft-ietf-opsawg-pcap, draft-ietf-opsawg-pcapng. libpcap is not used: it reads files, not
/// bytes, and does not distinguish the interfaces of a pcapng. Errors name the packet.
[[nodiscard]] base::Result<Capture> read_capture(std::string_view text);

} // namespace hapnet::emulator::tools

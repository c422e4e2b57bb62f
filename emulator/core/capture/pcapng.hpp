// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "proto/base/ip_marks.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace hapnet::emulator {

// A capture as pcapng (draft-ietf-opsawg-pcapng), which Wireshark and tshark open. It has two
// interfaces, "side A" and "side B", with whole raw IP packets and times in nanoseconds. A relay of
// datagrams knows only the IP marks of the headers. The rest of the headers is generated, with
// correct lengths and checksums.

enum class CaptureSide : std::uint8_t { a, b };

/// An address and a UDP port. An IPv4 address occupies the first four bytes.
struct UdpAddress {
    std::array<std::byte, 16> address{};
    std::uint16_t port = 0;
    bool is_v6 = false;
};

/// A datagram or an IP packet that arrived or left.
struct CapturedPacket {
    CaptureSide side = CaptureSide::a; // whose socket it passed
    bool is_outbound = false;          // sent by the emulator
    base::TimePoint at{};
    UdpAddress from{};
    UdpAddress to{};
    std::span<const std::byte> payload{}; // at most payload_bytes_max
    std::uint32_t pair = 0;               // number of the pair of sides, from 0
    base::IpMarks marks{};                // a hop limit of 0 is written as 64
    bool is_ip = false; // `payload` is a whole IP packet, with addresses and marks

    static constexpr std::size_t payload_bytes_max = 65'527; // over IPv6; 20 less over IPv4
};

/// The names of a pair's two interfaces.
struct CaptureNames {
    std::string a = "side A";
    std::string b = "side B";
};

/// Appends the beginning of a capture: the section header and the interfaces, two for each pair.
/// `program` is recorded as the application that wrote it.
void append_capture_head(std::string& bytes, std::string_view program,
                         std::span<const CaptureNames> pairs);

/// Appends one packet, with a comment of at most 65535 bytes. A datagram becomes an IPv4 packet
/// when each address is IPv4 or IPv4 in an IPv6 address (::ffff:1.2.3.4); otherwise IPv6.
/// `since_1970`: the time from 1970 to time point 0. No packet may be from before 1970.
void append_packet(std::string& bytes, const CapturedPacket& packet, base::Duration since_1970,
                   std::string_view comment);

/// Appends the comment of a datagram that arrived: "dropped: gilbert-elliott", or "delayed 163.2
/// ms" (as drawn; below 1 ms in us), with the other effects on it: ", copied", ", 1 bit corrupted",
/// ", displaced".
void append_arrival_comment(std::string& text, const Fate& fate);

/// Appends the comment of a datagram that left `late` after its due time: "late 7 us", and ", copy"
/// if it is one.
void append_departure_comment(std::string& text, base::Duration late, bool is_copy);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstdint>
#include <string>
#include <vector>

// Builds captures for tests by the formats' rules: big-endian headers of IP, and files.

namespace hapnet::test {

/// Big-endian numbers, one after the other.
class PacketBytes {
public:
    PacketBytes& u8(std::uint64_t value) { return number(value, 1); }
    PacketBytes& u16(std::uint64_t value) { return number(value, 2); }
    PacketBytes& u32(std::uint64_t value) { return number(value, 4); }
    PacketBytes& raw(const std::string& bytes)
    {
        bytes_ += bytes;
        return *this;
    }
    [[nodiscard]] const std::string& text() const { return bytes_; }

private:
    PacketBytes& number(std::uint64_t value, int bytes)
    {
        for (int i = bytes; i-- > 0;) bytes_ += static_cast<char>(value >> (8 * i) & 0xffU);
        return *this;
    }

    std::string bytes_;
};

struct Ipv4Ends {
    std::uint32_t from = 0x0a00'0001;
    std::uint32_t to = 0x0a00'0002;

    [[nodiscard]] Ipv4Ends back() const { return {to, from}; }
};

inline std::string ipv4_packet(std::uint8_t protocol, const std::string& payload,
                               Ipv4Ends ends = {}, std::uint16_t fragment = 0)
{
    PacketBytes packet;
    packet.u8(0x45).u8(0).u16(20 + payload.size()).u16(1).u16(fragment).u8(64).u8(protocol).u16(0);
    return packet.u32(ends.from).u32(ends.to).raw(payload).text();
}

inline std::string udp_packet(const std::string& payload, std::uint16_t from = 7000,
                              std::uint16_t to = 7001, Ipv4Ends ends = {})
{
    PacketBytes datagram;
    datagram.u16(from).u16(to).u16(8 + payload.size()).u16(0).raw(payload);
    return ipv4_packet(17, datagram.text(), ends);
}

inline std::string echo_packet(bool is_reply, std::uint16_t sequence, const std::string& payload)
{
    PacketBytes echo;
    echo.u8(is_reply ? 0 : 8).u8(0).u16(0).u16(77).u16(sequence).raw(payload);
    return ipv4_packet(1, echo.text(), is_reply ? Ipv4Ends{}.back() : Ipv4Ends{});
}

inline std::string tcp_packet(std::uint32_t sequence, const std::string& payload)
{
    PacketBytes segment;
    segment.u16(1000).u16(2000).u32(sequence).u32(0).u16(0x5010).u16(100).u16(0).u16(0);
    return ipv4_packet(6, segment.raw(payload).text());
}

/// A pcap file of raw IP packets, in big-endian order with times in nanoseconds.
class PcapFile {
public:
    explicit PcapFile(std::uint32_t link = 101)
    {
        bytes_.u32(0xa1b2'3c4d).u16(2).u16(4).u32(0).u32(0).u32(65'535).u32(link);
    }
    /// `at`: time since 1970. `captured`: the bytes that were kept.
    void add(base::Duration at, const std::string& packet, std::size_t captured = std::string::npos)
    {
        const auto kept = packet.substr(0, captured);
        const auto nanoseconds = static_cast<std::uint64_t>(at.count());
        bytes_.u32(nanoseconds / 1'000'000'000).u32(nanoseconds % 1'000'000'000);
        bytes_.u32(kept.size()).u32(packet.size()).raw(kept);
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_.text(); }

private:
    PacketBytes bytes_;
};

/// A payload of 24 bytes, unique to this number.
inline std::string numbered_payload(std::uint64_t number)
{
    return PacketBytes{}.raw("payload ").u32(number >> 32).u32(number).raw("12345678").text();
}

} // namespace hapnet::test

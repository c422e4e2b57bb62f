// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <initializer_list>
#include <vector>

namespace hapnet::emulator {

// Frames whose bytes were written by hand, by the RFCs. tshark reads them as their names say.

using Octets = std::vector<std::byte>;

inline Octets octets(std::initializer_list<unsigned> values)
{
    Octets bytes;
    for (const unsigned value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

inline Octets operator+(Octets front, const Octets& back)
{
    front.insert(front.end(), back.begin(), back.end());
    return front;
}

/// An Ethernet header of this type.
inline Octets ethernet(unsigned type)
{
    return octets({2, 0, 0, 0, 0, 0xb, 2, 0, 0, 0, 0, 0xa, type >> 8U, type & 255U});
}

/// From 10.0.0.1 to 10.0.0.2, with EF, a header of 20 bytes and `payload` (RFC 791). `place`: flags
/// and offset of a fragment, with the identification 0x1234.
inline Octets ipv4(unsigned protocol, const Octets& payload, unsigned place = 0)
{
    const auto total = static_cast<unsigned>(20 + payload.size());
    return ethernet(0x0800) + octets({0x45, 46 << 2,  total >> 8U, total & 255U,
                                      0x12, 0x34,     place >> 8U, place & 255U,
                                      64,   protocol, 0,           0,
                                      10,   0,        0,           1,
                                      10,   0,        0,           2}) +
           payload;
}

/// From fd00::1 to fd00::2, with EF (RFC 8200).
inline Octets ipv6(unsigned next, const Octets& payload)
{
    const auto bytes = static_cast<unsigned>(payload.size());
    auto from = octets({0xfd, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1});
    auto to = from;
    to.back() = std::byte{2};
    return ethernet(0x86dd) + octets({0x6b, 0x80, 0, 0, bytes >> 8U, bytes & 255U, next, 64}) +
           std::move(from) + to + payload;
}

/// Ports 4000 and 5004, and four bytes of payload (RFC 768).
inline Octets udp() { return octets({0x0f, 0xa0, 0x13, 0x8c, 0, 12, 0, 0, 1, 2, 3, 4}); }

/// From port 40000 to 22, without options (RFC 9293).
inline Octets tcp()
{
    return octets({0x9c, 0x40, 0, 22, 0, 0, 0, 1, 0, 0, 0, 0, 0x50, 2, 0xff, 0xff, 0, 0, 0, 0});
}

} // namespace hapnet::emulator

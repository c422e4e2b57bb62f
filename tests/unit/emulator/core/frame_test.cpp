// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/frame.hpp"

#include <gtest/gtest.h>
#include <initializer_list>
#include <vector>

namespace hapnet::emulator {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(std::initializer_list<unsigned> values)
{
    Bytes bytes;
    for (const unsigned value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

/// An Ethernet header with these tags and type, and the packet.
Bytes framed(std::initializer_list<unsigned> type, const Bytes& packet)
{
    Bytes frame = bytes_of({2, 0, 0, 0, 0, 0xb, 2, 0, 0, 0, 0, 0xa});
    for (const std::byte byte : bytes_of(type)) frame.push_back(byte);
    frame.insert(frame.end(), packet.begin(), packet.end());
    return frame;
}

/// A DNS-like datagram of four bytes over IPv4, with checksums computed by hand.
Bytes udp_v4()
{
    return bytes_of({0x45, 0, 0, 32, 0, 1, 0, 0, 64, 17, 0x66, 0xca, 10,  0,   0,   1,
                     10,   0, 0, 2,  0, 7, 0, 9, 0,  12, 0x13, 0x01, 'd', 'a', 't', 'a'});
}

Bytes icmp_v6(unsigned type)
{
    auto packet = bytes_of({0x60, 0, 0, 0, 0, 8, 58, 255});
    packet.resize(40);
    for (const std::byte byte : bytes_of({type, 0, 0, 0, 0, 0, 0, 0})) packet.push_back(byte);
    return packet;
}

TEST(Frame, IsKnownByItsTypeAlsoBehindVlanTags)
{
    const auto ip = read_frame(framed({8, 0}, udp_v4()));
    EXPECT_EQ(ip.kind, FrameKind::ip);
    EXPECT_EQ(ip.header_bytes, 14);
    EXPECT_EQ(ip.source.back(), std::byte{0xa});
    const auto tagged = read_frame(framed({0x81, 0, 0, 5, 8, 0}, udp_v4()));
    EXPECT_EQ(tagged.kind, FrameKind::ip);
    EXPECT_EQ(tagged.header_bytes, 18);
    const auto twice = read_frame(framed({0x88, 0xa8, 0, 5, 0x81, 0, 0, 6, 8, 6}, Bytes(28)));
    EXPECT_EQ(twice.kind, FrameKind::neighbours);
    EXPECT_EQ(twice.header_bytes, 22);
    EXPECT_EQ(read_frame(framed({0x88, 0xcc}, Bytes(50))).kind, FrameKind::other); // LLDP
}

TEST(Frame, TellsNeighbourDiscoveryFromOtherIcmp)
{
    for (unsigned type = 0; type < 256; ++type) {
        const auto kind = read_frame(framed({0x86, 0xdd}, icmp_v6(type))).kind;
        const bool is_discovery = type >= 133 && type <= 137;
        EXPECT_EQ(kind, is_discovery ? FrameKind::neighbours : FrameKind::ip) << type;
    }
}

TEST(Frame, OfAnyLengthIsReadWithinItsBytes)
{
    const auto whole = framed({0x81, 0, 0, 5, 0x86, 0xdd}, icmp_v6(135));
    for (std::size_t length = 0; length <= whole.size(); ++length) {
        const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
        EXPECT_LE(read_frame(part).header_bytes, length) << length;
    }
}

TEST(FixChecksums, LeavesRightOnesAndMendsWrongOnes)
{
    const auto right = framed({8, 0}, udp_v4());
    auto same = right;
    fix_checksums(same);
    EXPECT_EQ(same, right);
    auto wrong = right;
    wrong[14 + 10] ^= std::byte{0x40}; // of the header
    wrong[14 + 26] ^= std::byte{0x01}; // of UDP
    fix_checksums(wrong);
    EXPECT_EQ(wrong, right);
}

TEST(FixChecksums, GivesDamagedDataOneThatFits)
{
    auto damaged = framed({8, 0}, udp_v4());
    damaged.back() ^= std::byte{0x10};
    const auto before = damaged;
    fix_checksums(damaged);
    ASSERT_NE(damaged, before);
    EXPECT_EQ(damaged.back(), before.back());
    auto again = damaged;
    fix_checksums(again);
    EXPECT_EQ(again, damaged);
}

TEST(FixChecksums, LeavesADatagramWithoutOneAndAFragmentAlone)
{
    auto without = framed({8, 0}, udp_v4());
    without[14 + 26] = without[14 + 27] = std::byte{0};
    const auto was = without;
    fix_checksums(without);
    EXPECT_EQ(without, was);
    auto fragment = framed({8, 0}, udp_v4());
    fragment[14 + 6] = std::byte{0x20}; // more fragments
    fragment[14 + 26] ^= std::byte{0x01};
    const auto udp_checksum = fragment[14 + 26];
    fix_checksums(fragment);
    EXPECT_EQ(fragment[14 + 26], udp_checksum);
}

TEST(FixChecksums, ComputesThoseOfIpv6)
{
    auto frame = framed({0x86, 0xdd}, icmp_v6(128));
    fix_checksums(frame);
    // The sum of pseudo-header (8 + 58) and message (0x8000), complemented.
    EXPECT_EQ(frame[14 + 42], std::byte{0x7f});
    EXPECT_EQ(frame[14 + 43], std::byte{0xbd});
}

} // namespace
} // namespace hapnet::emulator

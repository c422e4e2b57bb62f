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

TEST(Frame, SaysWhichMachineItIsFor)
{
    const auto frame = framed({8, 0}, udp_v4());
    EXPECT_EQ(destination_of(frame)->back(), std::byte{0xb});
    auto to_all = frame;
    to_all[0] = std::byte{0xff};
    EXPECT_EQ(destination_of(to_all), std::nullopt);
    auto to_group = frame;
    to_group[0] = std::byte{0x33}; // a multicast address of IPv6
    EXPECT_EQ(destination_of(to_group), std::nullopt);
    EXPECT_EQ(destination_of(std::span{frame}.first(13)), std::nullopt);
}

TEST(Frame, HasAnIpPacketWithoutWhatFillsItUp)
{
    const auto packet_in = [](const Bytes& frame) {
        const auto packet = ip_packet_of(frame);
        return Bytes{packet.begin(), packet.end()};
    };
    auto filled = udp_v4();
    filled.resize(46); // the least that Ethernet carries
    EXPECT_EQ(packet_in(framed({8, 0}, filled)), udp_v4());
    EXPECT_EQ(packet_in(framed({0x81, 0, 0, 5, 8, 0}, udp_v4())), udp_v4());
    auto filled_v6 = icmp_v6(128);
    filled_v6.resize(60);
    EXPECT_EQ(packet_in(framed({0x86, 0xdd}, filled_v6)), icmp_v6(128));
    auto cut = udp_v4(); // its header claims more bytes
    cut.resize(25);
    EXPECT_EQ(packet_in(framed({8, 0}, cut)), cut);
    EXPECT_EQ(packet_in(framed({8, 6}, Bytes(28))), Bytes{});
    EXPECT_EQ(packet_in(bytes_of({2, 0, 0})), Bytes{});
}

TEST(Frame, SaysWhetherItAnswersThatNoProgramListens)
{
    const auto says = [](const Bytes& frame) {
        return says_port_unreachable(read_frame(frame), frame);
    };
    // IPv4 with an option of four bytes, so that ICMP begins at 24.
    const auto answer = [](unsigned protocol, unsigned type, unsigned code) {
        auto packet = bytes_of({0x46, 0, 0, 32, 0, 1, 0, 0, 64, protocol});
        packet.resize(24);
        for (const std::byte byte : bytes_of({type, code, 0, 0, 0, 0, 0, 0})) {
            packet.push_back(byte);
        }
        return packet;
    };
    EXPECT_TRUE(says(framed({8, 0}, answer(1, 3, 3))));
    EXPECT_TRUE(says(framed({0x81, 0, 0, 5, 8, 0}, answer(1, 3, 3))));
    EXPECT_FALSE(says(framed({8, 0}, answer(1, 3, 1)))); // the host
    EXPECT_FALSE(says(framed({8, 0}, answer(1, 11, 3))));
    EXPECT_FALSE(says(framed({8, 0}, answer(17, 3, 3))));
    EXPECT_FALSE(says(framed({8, 0}, udp_v4())));
    auto unreachable = icmp_v6(1);
    EXPECT_FALSE(says(framed({0x86, 0xdd}, unreachable))); // no route
    unreachable[41] = std::byte{4};
    EXPECT_TRUE(says(framed({0x86, 0xdd}, unreachable)));
    unreachable.resize(41); // cut off
    EXPECT_FALSE(says(framed({0x86, 0xdd}, unreachable)));
    EXPECT_FALSE(says({}));
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

TEST(Marks, AreThoseOfTheIpHeader)
{
    EXPECT_EQ(read_frame(framed({8, 0}, udp_v4())).marks, (base::IpMarks{0, 64}));
    auto packet = icmp_v6(128);
    packet[0] = std::byte{0x6b};
    packet[1] = std::byte{0x9f}; // the rest of the class, and of the flow label
    EXPECT_EQ(read_frame(framed({0x86, 0xdd}, packet)).marks, (base::IpMarks{0xb9, 255}));
    EXPECT_EQ(read_frame(framed({8, 6}, Bytes(28))).marks, base::IpMarks{}); // ARP has none
    const auto whole = framed({8, 0}, udp_v4());
    const Bytes cut(whole.begin(), whole.begin() + 14 + 19);
    EXPECT_EQ(read_frame(cut).marks, base::IpMarks{});
}

TEST(MarkCongestion, SetsBothBitsAndKeepsTheChecksumRight)
{
    for (const unsigned tos : {0x01U, 0x02U, 0xb9U, 0xbaU, 0x03U}) {
        auto packet = udp_v4();
        packet[1] = static_cast<std::byte>(tos);
        auto frame = framed({0x81, 0, 0, 5, 8, 0}, packet);
        fix_checksums(frame);
        mark_congestion(frame);
        EXPECT_EQ(read_frame(frame).marks,
                  (base::IpMarks{static_cast<std::uint8_t>(tos | 3U), 64}));
        auto fixed = frame;
        fix_checksums(fixed);
        EXPECT_EQ(fixed, frame) << tos;
    }
    auto packet = icmp_v6(128);
    packet[1] = std::byte{0x25}; // ECT(0), and a flow label
    auto frame = framed({0x86, 0xdd}, packet);
    mark_congestion(frame);
    EXPECT_EQ(frame[14], std::byte{0x60});
    EXPECT_EQ(frame[15], std::byte{0x35});
}

TEST(Flows, AreToldApartByAddressesProtocolAndPorts)
{
    const auto flow_with = [](std::size_t place) {
        auto packet = udp_v4();
        packet[place] ^= std::byte{0x04};
        return flow_of(framed({8, 0}, packet));
    };
    const auto flow = flow_of(framed({8, 0}, udp_v4()));
    EXPECT_EQ(flow_of(framed({0x81, 0, 0, 5, 8, 0}, udp_v4())), flow); // a tag is none of it
    for (const std::size_t same : {1U, 4U, 8U, 24U, 28U}) EXPECT_EQ(flow_with(same), flow) << same;
    for (const std::size_t other : {9U, 12U, 15U, 16U, 19U, 20U, 21U, 22U, 23U}) {
        EXPECT_NE(flow_with(other), flow) << other;
    }
}

TEST(Flows, KeepTheFragmentsOfAPacketTogether)
{
    auto first = udp_v4();
    first[6] = std::byte{0x20}; // more fragments
    auto second = udp_v4();
    second[7] = std::byte{0x01}; // of an offset: what stands in the place of ports is data
    second[20] = std::byte{0x99};
    EXPECT_EQ(flow_of(framed({8, 0}, first)), flow_of(framed({8, 0}, second)));
    EXPECT_NE(flow_of(framed({8, 0}, first)), flow_of(framed({8, 0}, udp_v4())));
}

TEST(Flows, OfIpv6AreToldApart)
{
    const auto flow = flow_of(framed({0x86, 0xdd}, icmp_v6(128)));
    auto other = icmp_v6(128);
    other[39] = std::byte{1}; // of the destination
    EXPECT_NE(flow_of(framed({0x86, 0xdd}, other)), flow);
    EXPECT_EQ(flow_of(framed({8, 6}, Bytes(28))), 0U);
}

} // namespace
} // namespace hapnet::emulator

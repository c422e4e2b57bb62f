// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/packet_facts.hpp"

#include "tests/unit/emulator/core/flow/packets.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

using Part = PacketFacts::Part;

std::optional<PacketFacts> facts_in(const Octets& frame)
{
    return facts_of(read_frame(frame), frame);
}

Address v6(unsigned last) { return {0xfd00'0000'0000'0000ULL, last}; }
Address v4(unsigned last) { return {0, 0xffff'0a00'0000ULL | last}; }

TEST(PacketFacts, AreThoseOfADatagramOverIpv4)
{
    const auto facts = facts_in(ipv4(17, udp()));
    ASSERT_TRUE(facts);
    EXPECT_EQ(facts->protocol, 17);
    EXPECT_EQ(facts->version, 4);
    EXPECT_EQ(facts->dscp, 46);
    EXPECT_TRUE(facts->has_ports);
    EXPECT_EQ(facts->from_port, 4000);
    EXPECT_EQ(facts->to_port, 5004);
    EXPECT_EQ(facts->bytes, 32U);
    EXPECT_EQ(facts->from, v4(1));
    EXPECT_EQ(facts->to, v4(2));
    EXPECT_EQ(facts->part, Part::whole);
}

TEST(PacketFacts, AreThoseOfASegmentOverIpv6)
{
    const auto facts = facts_in(ipv6(6, tcp()));
    ASSERT_TRUE(facts);
    EXPECT_EQ(facts->protocol, 6);
    EXPECT_EQ(facts->version, 6);
    EXPECT_EQ(facts->dscp, 46);
    EXPECT_EQ(facts->from_port, 40000);
    EXPECT_EQ(facts->to_port, 22);
    EXPECT_EQ(facts->bytes, 60U);
    EXPECT_EQ(facts->from, v6(1));
    EXPECT_EQ(facts->to, v6(2));
}

TEST(PacketFacts, StandBehindIpv4OptionsAndVlanTagsAndBeforeThePadding)
{
    auto frame = ipv4(17, octets({1, 1, 1, 1}) + udp()); // four times no operation
    frame[14] = std::byte{0x46};
    frame.resize(60); // the shortest frame of Ethernet
    frame.insert(frame.begin() + 12, {std::byte{0x81}, std::byte{0}, std::byte{0}, std::byte{7}});
    const auto facts = facts_in(frame);
    ASSERT_TRUE(facts);
    EXPECT_EQ(facts->to_port, 5004);
    EXPECT_EQ(facts->bytes, 36U);
}

TEST(PacketFacts, SkipExtensionHeadersOfIpv6)
{
    const auto hop_by_hop = octets({60, 0, 1, 4, 0, 0, 0, 0}); // then options
    const auto options = octets({43, 1, 1, 12, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    const auto routing = octets({51, 0, 0, 0, 0, 0, 0, 0}); // then authentication
    const auto authentication = octets({17, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1});
    const auto facts = facts_in(ipv6(0, hop_by_hop + options + routing + authentication + udp()));
    ASSERT_TRUE(facts);
    EXPECT_EQ(facts->protocol, 17);
    EXPECT_EQ(facts->to_port, 5004);
}

TEST(PacketFacts, LackPortsWhereTheProtocolHasNone)
{
    for (const unsigned protocol : {1U, 47U, 50U, 58U, 59U}) {
        const auto facts = facts_in(ipv6(protocol, octets({8, 0, 0, 0})));
        ASSERT_TRUE(facts) << protocol;
        EXPECT_EQ(facts->protocol, protocol);
        EXPECT_FALSE(facts->has_ports);
    }
}

TEST(PacketFacts, TellFragmentsApart)
{
    const auto first = facts_in(ipv4(17, udp(), 0x2000));
    ASSERT_TRUE(first);
    EXPECT_EQ(first->part, Part::first);
    EXPECT_EQ(first->fragment_id, 0x1234U);
    EXPECT_EQ(first->to_port, 5004);
    const auto later = facts_in(ipv4(17, octets({1, 2, 3}), 0x0002));
    ASSERT_TRUE(later);
    EXPECT_EQ(later->part, Part::later);
    EXPECT_FALSE(later->has_ports);
    EXPECT_EQ(facts_in(ipv4(17, udp(), 0x4000))->part, Part::whole); // do not fragment

    const auto fragment = [](unsigned place) {
        return octets({17, 0, place >> 8U, place & 255U, 0xde, 0xad, 0xbe, 0xef});
    };
    const auto first_v6 = facts_in(ipv6(44, fragment(1) + udp()));
    ASSERT_TRUE(first_v6);
    EXPECT_EQ(first_v6->part, Part::first);
    EXPECT_EQ(first_v6->fragment_id, 0xdead'beefU);
    EXPECT_EQ(first_v6->to_port, 5004);
    EXPECT_EQ(facts_in(ipv6(44, fragment(0x08) + udp()))->part, Part::later);
    EXPECT_EQ(facts_in(ipv6(44, fragment(0) + udp()))->part, Part::whole); // atomic: RFC 6946
}

TEST(PacketFacts, AreOfArpItsProtocolAlone)
{
    const auto facts = facts_in(ethernet(0x0806) + Octets(28));
    ASSERT_TRUE(facts);
    EXPECT_EQ(facts->protocol, PacketFacts::arp);
    EXPECT_EQ(facts->version, 0);
}

TEST(PacketFacts, AreUnknownWhereHeadersAreCutOffOrContradictEachOther)
{
    for (const auto& whole : {ipv4(17, udp()), ipv6(6, tcp())}) {
        for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
            EXPECT_FALSE(
                facts_in({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(bytes)}))
                << bytes;
        }
    }
    auto short_header = ipv4(17, udp());
    short_header[14] = std::byte{0x44};
    EXPECT_FALSE(facts_in(short_header));
    auto wrong_version = ipv4(17, udp());
    wrong_version[14] = std::byte{0x65};
    EXPECT_FALSE(facts_in(wrong_version));
    EXPECT_FALSE(facts_in(ipv4(17, octets({0, 1, 0})))); // ports cut off
    EXPECT_FALSE(
        facts_in(ipv6(0, octets({17, 9, 0, 0, 0, 0, 0, 0})))); // a header beyond the packet
    EXPECT_FALSE(facts_in(ethernet(0x88cc) + Octets(50)));     // LLDP
}

TEST(PacketFacts, AreUnknownBehindTooManyExtensionHeaders)
{
    Octets headers;
    for (int i = 0; i < 8; ++i) headers = headers + octets({60, 0, 1, 4, 0, 0, 0, 0});
    headers[7 * 8] = std::byte{17};
    EXPECT_TRUE(facts_in(ipv6(60, headers + udp())));
    EXPECT_FALSE(facts_in(ipv6(60, octets({60, 0, 1, 4, 0, 0, 0, 0}) + headers + udp())));
}

} // namespace
} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/match.hpp"

#include "emulator/core/flow/packet_facts.hpp"
#include "proto/base/fields.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

base::Result<Match> match_in(const std::string& text)
{
    return base::parse_text(text, "profile", [](const base::Node& node, base::Reading& reading) {
        Match match;
        base::read_table(node, match, reading);
        return match;
    });
}

std::string complaint(const std::string& text) { return match_in(text).error().message; }

TEST(Match, IsPrintedAsItIsRead)
{
    const std::string text = R"(protocol = "udp"
ports = "5000-5100"
to_port = 22
from_port = "1024-65535"
host = "10.0.0.1"
net = "10.0.0.0/8"
to_net = "fe80::/10"
from_net = "::1"
dscp = "ef"
ip = 6
size = "..100"
)";
    const auto match = match_in(text);
    ASSERT_TRUE(match) << match.error().message;
    EXPECT_EQ(match->ports, (NumberRange{5000, 5100}));
    EXPECT_EQ(match->dscp, 46);
    EXPECT_EQ(base::field_lines(*match), text);
}

TEST(Match, KnowsNamesAndNumbers)
{
    EXPECT_EQ(match_in("protocol = \"icmpv6\"")->protocol, 58);
    EXPECT_EQ(match_in("protocol = 17")->protocol, 17);
    EXPECT_EQ(match_in("protocol = \"arp\"")->protocol, PacketFacts::arp);
    EXPECT_EQ(match_in("protocol = 200")->protocol, 200);
    EXPECT_EQ(base::field_lines(*match_in("protocol = 200")), "protocol = 200\n");
    EXPECT_EQ(match_in("dscp = \"af41\"")->dscp, 34);
    EXPECT_EQ(base::field_lines(*match_in("dscp = 63")), "dscp = 63\n");
}

TEST(Match, TakesOpenRangesOfSizes)
{
    EXPECT_EQ(match_in("size = \"..100\"")->size, (NumberRange{0, 100}));
    EXPECT_EQ(match_in("size = \"1000..\"")->size, (NumberRange{1000, 65535}));
    EXPECT_EQ(match_in("size = \"100..200\"")->size, (NumberRange{100, 200}));
    EXPECT_EQ(match_in("size = 60")->size, (NumberRange{60, 60}));
    for (const char* const text : {"\"1000..\"", "\"100..200\"", "60", "\"0..65535\""}) {
        const auto match = match_in(std::string{"size = "} + text);
        ASSERT_TRUE(match) << text;
        EXPECT_EQ(match_in(base::field_lines(*match))->size, match->size) << text;
    }
}

TEST(Match, SaysWhereAWrongValueStandsAndWhatWouldBeRight)
{
    EXPECT_EQ(complaint("protocol = \"upd\""),
              "profile:1:12: unknown name 'upd': did you mean 'udp'?, or a number to 255");
    EXPECT_EQ(complaint("prot = \"udp\""), "profile:1:1: unknown key 'prot': did you mean 'port'?");
    EXPECT_NE(complaint("port = 70000").find("a port such as 5004"), std::string::npos);
    EXPECT_NE(complaint("ports = \"5100-5000\"").find("\"5000-5100\""), std::string::npos);
    EXPECT_NE(complaint("ports = \"5100-\"").find("\"5000-5100\""), std::string::npos);
    EXPECT_NE(complaint("size = \"..\"").find("\"..100\""), std::string::npos);
    EXPECT_NE(complaint("ip = 5").find("4 or 6"), std::string::npos);
    EXPECT_EQ(complaint("host = \"10.0.0.0/8\""),
              "profile:1:8: 10.0.0.0/8 is a network: write net = \"10.0.0.0/8\"");
}

TEST(Match, HasToSaySomethingThatAPacketCanMeet)
{
    EXPECT_FALSE(validate(Match{}));
    EXPECT_TRUE(validate({.protocol = 17}));
    EXPECT_FALSE(validate({.port = NumberRange{1, 1}, .ports = NumberRange{2, 3}}));
    EXPECT_FALSE(validate({.protocol = PacketFacts::arp, .port = NumberRange{1, 1}}));
    EXPECT_TRUE(validate({.protocol = PacketFacts::arp}));
}

} // namespace
} // namespace hapnet::emulator

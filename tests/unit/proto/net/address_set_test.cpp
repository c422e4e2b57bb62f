// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/address_set.hpp"

#include <gtest/gtest.h>

namespace hapnet::net {
namespace {

Endpoint address(std::string_view text) { return resolve(*parse_host_port(text)); }

AddressSet set_of(std::initializer_list<std::string_view> texts)
{
    AddressSet set;
    for (const auto text : texts) EXPECT_TRUE(set.add(*parse_address_pattern(text))) << text;
    return set;
}

TEST(AddressSet, HasOnePortOfAHostOrAllOfThem)
{
    const auto one = set_of({"10.0.0.1:7000"});
    EXPECT_TRUE(one.contains(address("10.0.0.1:7000")));
    EXPECT_FALSE(one.contains(address("10.0.0.1:7001")));
    EXPECT_FALSE(one.contains(address("10.0.0.2:7000")));
    for (const auto text : {"10.0.0.1", "10.0.0.1:*"}) {
        const auto all = set_of({text});
        EXPECT_TRUE(all.contains(address("10.0.0.1:7001")));
        EXPECT_FALSE(all.contains(address("10.0.0.2:7001")));
    }
    for (const auto text : {"fd00::1", "[fd00::1]", "[fd00::1]:*"}) {
        EXPECT_TRUE(set_of({text}).contains(address("[fd00::1]:9"))) << text;
        EXPECT_FALSE(set_of({text}).contains(address("[fd00::2]:9"))) << text;
    }
}

TEST(AddressSet, HasTheHostsOfANetworkAndNoOthers)
{
    const auto set = set_of({"192.0.2.128/25", "fd00:1::/33"});
    EXPECT_TRUE(set.contains(address("192.0.2.128:1")));
    EXPECT_TRUE(set.contains(address("192.0.2.255:2")));
    EXPECT_FALSE(set.contains(address("192.0.2.127:1")));
    EXPECT_FALSE(set.contains(address("193.0.2.129:1")));
    EXPECT_TRUE(set.contains(address("[fd00:1:7fff::1]:1")));
    EXPECT_FALSE(set.contains(address("[fd00:1:8000::1]:1")));
    EXPECT_TRUE(set_of({"0.0.0.0/0"}).contains(address("203.0.113.5:1")));
    EXPECT_FALSE(set_of({"0.0.0.0/0"}).contains(address("[fd00::1]:1")));
}

TEST(AddressSet, TakesAnAddressThatAnIpv6SocketHeardForTheIpv4OneThatItIs)
{
    EXPECT_TRUE(set_of({"10.0.0.0/8"}).contains(address("[::ffff:10.1.2.3]:5")));
    EXPECT_FALSE(set_of({"10.0.0.0/8"}).contains(address("[::ffff:11.1.2.3]:5")));
}

TEST(AddressSet, KnowsWhetherAllOfItIsOnThisMachine)
{
    EXPECT_TRUE(set_of({"127.0.0.1", "127.0.0.0/8", "[::1]:9"}).is_loopback());
    EXPECT_FALSE(set_of({"127.0.0.1", "10.0.0.1"}).is_loopback());
    EXPECT_FALSE(set_of({"126.0.0.0/7"}).is_loopback());
    EXPECT_FALSE(set_of({"::/0"}).is_loopback());
}

TEST(AddressSet, HasTheAddressesOfThisMachine)
{
    const auto own = addresses_of_this_machine();
    EXPECT_TRUE(own.contains(address("127.0.0.1:1")));
    EXPECT_TRUE(own.contains(address("127.1.2.3:1")));
    EXPECT_FALSE(own.contains(address("203.0.113.5:1"))); // reserved for documentation
}

TEST(AddressPattern, RefusesWhatIsNoAddressAndSaysWhatWouldBeOne)
{
    const auto said = [](std::string_view text) {
        const auto pattern = parse_address_pattern(text);
        return pattern ? std::string{} : pattern.error().message;
    };
    EXPECT_NE(said("10.0.0.0/33").find("at most 32 bits"), std::string::npos);
    EXPECT_NE(said("host/8").find("NET/BITS"), std::string::npos);
    EXPECT_NE(said("10.0.0.0/x").find("NET/BITS"), std::string::npos);
    EXPECT_NE(said("10.0.0.1:0").find("10.0.0.1:* for any port"), std::string::npos);
    EXPECT_NE(said("::1:*").find("[::1]:*"), std::string::npos);
    EXPECT_NE(said("").find("HOST:PORT"), std::string::npos);
    AddressSet set;
    const auto added = set.add(*parse_address_pattern("10.0.0.1/8"));
    ASSERT_FALSE(added);
    EXPECT_NE(added.error().message.find("beyond its length"), std::string::npos);
}

} // namespace
} // namespace hapnet::net

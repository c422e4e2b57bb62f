// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/endpoint.hpp"

#include <gtest/gtest.h>
#include <system_error>

namespace hapnet::net {
namespace {

Endpoint endpoint(std::string_view text) { return resolve(parse_host_port(text).value()); }

TEST(Endpoint, ToListenOnMayBeAPortOfLoopback)
{
    for (const std::string_view text : {":7001", "7001", "127.0.0.1:7001"}) {
        const auto address = parse_listen_address(text);
        ASSERT_TRUE(address) << text;
        EXPECT_EQ(address->host, "127.0.0.1") << text;
        EXPECT_EQ(address->port, 7001) << text;
    }
    EXPECT_EQ(parse_listen_address("[::1]:7001")->host, "::1");
    for (const std::string_view text : {"", ":", "here", "70000", ":x", "-1"}) {
        EXPECT_FALSE(parse_listen_address(text)) << text;
    }
}

TEST(Endpoint, TakesHostAndPortApart)
{
    const auto v4 = parse_host_port("127.0.0.1:7001").value();
    EXPECT_EQ(v4.host, "127.0.0.1");
    EXPECT_EQ(v4.port, 7001);
    const auto v6 = parse_host_port("[::1]:0").value();
    EXPECT_EQ(v6.host, "::1");
    EXPECT_EQ(v6.port, 0);
    EXPECT_EQ(parse_host_port("peer.example:65535").value().port, 65535);
}

TEST(Endpoint, KnowsWhetherItReachesASocketOfThisMachine)
{
    const auto one = endpoint("127.0.0.1:7001");
    EXPECT_TRUE(one.reaches(one));
    EXPECT_TRUE(one.reaches(endpoint("0.0.0.0:7001")));
    EXPECT_FALSE(one.reaches(endpoint("127.0.0.1:7002")));
    EXPECT_FALSE(one.reaches(endpoint("0.0.0.0:7002")));
    EXPECT_FALSE(one.reaches(endpoint("[::]:7001")));
    EXPECT_FALSE(endpoint("10.0.0.1:7001").reaches(endpoint("0.0.0.0:7001")));
}

TEST(Endpoint, RefusesWhatIsNotHostAndPort)
{
    for (const std::string_view text :
         {"", ":", ":7001", "127.0.0.1", "7001", "host:", "host:-1", "host:65536", "host:70 01",
          "host:7001 ", "host:0x10", "::1:7001", "[::1]", "[::1]7001", "[::1:7001", "[]:7001",
          "a:b:7001"}) {
        EXPECT_FALSE(parse_host_port(text)) << text;
    }
}

TEST(Endpoint, ARefusalShowsTheTextAndHowItShouldLook)
{
    EXPECT_EQ(parse_host_port("*:7001").error().message,
              "'*:7001': write 0.0.0.0:7001 or [::]:7001 for all addresses of this machine");
    EXPECT_NE(parse_host_port("7001").error().message.find("HOST:PORT"), std::string::npos);
    EXPECT_NE(parse_host_port("::1:7001").error().message.find("[::1]:7001"), std::string::npos);
    EXPECT_NE(parse_host_port("host:99999").error().message.find("'99999'"), std::string::npos);
}

TEST(Endpoint, PrintsAsItIsRead)
{
    for (const std::string_view text : {"127.0.0.1:7001", "0.0.0.0:0", "[::1]:7001", "[::]:65535",
                                        "[2001:db8::1]:9", "10.1.2.3:65535"}) {
        EXPECT_EQ(endpoint(text).to_text(), text);
    }
}

TEST(Endpoint, KnowsLoopbackAndTheUnspecifiedAddress)
{
    EXPECT_TRUE(endpoint("127.0.0.1:1").is_loopback());
    EXPECT_TRUE(endpoint("127.200.3.4:1").is_loopback());
    EXPECT_TRUE(endpoint("[::1]:1").is_loopback());
    EXPECT_TRUE(endpoint("[::ffff:127.0.0.1]:1").is_loopback());
    EXPECT_FALSE(endpoint("128.0.0.1:1").is_loopback());
    EXPECT_FALSE(endpoint("[2001:db8::1]:1").is_loopback());
    EXPECT_FALSE(endpoint("0.0.0.0:1").is_loopback());
    EXPECT_TRUE(endpoint("0.0.0.0:1").is_any());
    EXPECT_TRUE(endpoint("[::]:1").is_any());
    EXPECT_FALSE(endpoint("127.0.0.1:1").is_any());
    EXPECT_FALSE(endpoint("[::1]:1").is_any());
}

TEST(Endpoint, EqualityIsAddressAndPort)
{
    EXPECT_EQ(endpoint("127.0.0.1:1"), endpoint("127.0.0.1:1"));
    EXPECT_FALSE(endpoint("127.0.0.1:1") == endpoint("127.0.0.1:2"));
    EXPECT_FALSE(endpoint("127.0.0.1:1") == endpoint("127.0.0.2:1"));
    EXPECT_EQ(endpoint("[::1]:1"), endpoint("[::1]:1"));
    EXPECT_FALSE(endpoint("[::1]:1") == endpoint("[::2]:1"));
    EXPECT_FALSE(endpoint("[::ffff:127.0.0.1]:1") == endpoint("127.0.0.1:1"));
}

TEST(Endpoint, AnAddressOfTheOtherFamilyDoesNotResolve)
{
    EXPECT_THROW(std::ignore = resolve({"127.0.0.1", 1}, AF_INET6), std::system_error);
    EXPECT_EQ(resolve({"127.0.0.1", 1}, AF_INET).family(), AF_INET);
}

TEST(Endpoint, ANameThatDoesNotResolveIsNamed)
{
    try {
        std::ignore = resolve({"no such name", 7001}); // a space: never asked of a name server
        FAIL() << "resolved";
    } catch (const std::system_error& error) {
        EXPECT_NE(std::string{error.what()}.find("'no such name'"), std::string::npos);
    }
}

TEST(Endpoint, LoopbackHasARoute) { EXPECT_NO_THROW(require_route(endpoint("127.0.0.1:9"))); }

TEST(Endpoint, LoopbackHasNoRouteToTheWorld)
{
    EXPECT_NO_THROW(require_route(endpoint("127.0.0.1:0"), endpoint("127.0.0.1:9")));
    EXPECT_THROW(require_route(endpoint("127.0.0.1:0"), endpoint("192.0.2.1:9")),
                 std::system_error);
}

TEST(Endpoint, IsOneHostUnlessItStandsForMany)
{
    for (const char* one : {"127.0.0.1:1", "192.0.2.1:1", "[::1]:1", "[2001:db8::1]:1"}) {
        EXPECT_TRUE(endpoint(one).is_one_host()) << one;
    }
    for (const char* many : {"0.0.0.0:1", "224.0.0.1:1", "239.255.255.255:1", "255.255.255.255:1",
                             "[::]:1", "[ff02::1]:1"}) {
        EXPECT_FALSE(endpoint(many).is_one_host()) << many;
    }
    EXPECT_EQ(endpoint("[::1]:7").with_port(9).to_text(), "[::1]:9");
    EXPECT_EQ(endpoint("127.0.0.1:7").with_port(0).to_text(), "127.0.0.1:0");
}

} // namespace
} // namespace hapnet::net

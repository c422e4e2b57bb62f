// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/address.hpp"

#include <gtest/gtest.h>

namespace hapnet::emulator {
namespace {

Address host(std::string_view text)
{
    std::array<std::byte, 4> bytes{};
    if (text == "10.1.2.3") {
        bytes = {std::byte{10}, std::byte{1}, std::byte{2}, std::byte{3}};
    }
    return address_of(bytes);
}

TEST(Net, ContainsTheAddressesWithItsFirstBits)
{
    const auto ten = Net::parse("10.0.0.0/8");
    ASSERT_TRUE(ten);
    EXPECT_TRUE(ten->contains(host("10.1.2.3"), 4));
    EXPECT_FALSE(ten->contains(host("0.0.0.0"), 4));
    EXPECT_FALSE(Net::parse("10.1.2.4")->contains(host("10.1.2.3"), 4));
    EXPECT_TRUE(Net::parse("10.1.2.2/31")->contains(host("10.1.2.3"), 4));
    EXPECT_TRUE(Net::parse("0.0.0.0/0")->contains(host("10.1.2.3"), 4));
}

TEST(Net, IsOfOneVersionOfIp)
{
    EXPECT_FALSE(Net::parse("::/0")->contains(host("10.1.2.3"), 4));
    EXPECT_TRUE(Net::parse("::/0")->contains({0xfe80'0000'0000'0000ULL, 1}, 6));
    EXPECT_TRUE(Net::parse("fe80::/10")->contains({0xfebf'0000'0000'0000ULL, 1}, 6));
    EXPECT_FALSE(Net::parse("fe80::/10")->contains({0xfec0'0000'0000'0000ULL, 1}, 6));
    EXPECT_TRUE(Net::parse("2001:db8::1:0:0:5")
                    ->contains({0x2001'0db8'0000'0000ULL, 0x0001'0000'0000'0005ULL}, 6));
}

TEST(Net, IsPrintedAsItIsRead)
{
    for (const char* const text :
         {"10.0.0.1", "10.0.0.0/8", "0.0.0.0/0", "::", "::/0", "::1", "fe80::/10", "2001:db8::1",
          "2001:db8:0:1:1:1:1:1", "2001:db8::1:0:0:1", "1:2:3:4:5:6:7:8", "fd00:0:0:1::/64"}) {
        const auto net = Net::parse(text);
        ASSERT_TRUE(net) << text << ": " << net.error().message;
        EXPECT_EQ(net->text(), text);
    }
}

TEST(Net, IsRefusedWithWhatWouldBeRight)
{
    for (const char* const text :
         {"", "10.0.0", "10.0.0.256", "10.0.0.01", "10.0.0.1/33", "10.0.0.0/", "1:2:3:4:5:6:7",
          "1::2::3", ":::", "fe80::g", "12345::", "1:2:3:4:5:6:7:8:9", "::/129", "host"}) {
        const auto net = Net::parse(text);
        ASSERT_FALSE(net) << text;
        EXPECT_NE(net.error().message.find("such as 10.0.0.0/8"), std::string::npos) << text;
    }
    EXPECT_EQ(Net::parse("10.1.2.3/8").error().message,
              "'10.1.2.3/8' says more bits than count: write 10.0.0.0/8");
}

} // namespace
} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/packet.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace hapnet::device::falcon {
namespace {

Packet packet_in(std::string_view text)
{
    Packet packet{};
    std::transform(text.begin(), text.end(), packet.begin(),
                   [](char letter) { return static_cast<std::byte>(letter); });
    return packet;
}

std::string text_of(const Packet& packet)
{
    std::string text;
    for (const std::byte byte : packet) text += static_cast<char>(byte);
    return text;
}

/// The packets that a finder makes of the text, one after another.
std::string found_in(std::string_view text, PacketFinder& finder)
{
    std::string found;
    for (const char letter : text) {
        if (const auto packet = finder.feed(static_cast<std::byte>(letter))) {
            found += text_of(*packet);
        }
    }
    return found;
}

TEST(FalconPacket, OfACommandIsWhatTheDescriptionSays)
{
    // 1 is the nibbles 1 0 0 0, -1 is f f f f, 4096 is 0 0 0 1; each plus 'A'.
    EXPECT_EQ(text_of(encode(Command{})), "<AAAAAAAAAAAAAA>");
    EXPECT_EQ(text_of(encode(Command{.motors = {1, -1, 4096}})), "<BAAAPPPPAAABAA>");
    EXPECT_EQ(text_of(encode(Command{.lights = Lights::red, .home = true})), "<AAAAAAAAAAAAJA>");
    EXPECT_EQ(text_of(encode(Command{.lights = Lights::green})), "<AAAAAAAAAAAACA>");
}

TEST(FalconPacket, OfAReportIsWhatTheDescriptionSays)
{
    // 0x1234 comes as 4 3 2 1; the flags are 7 << 4 | 4, above 'A'.
    const auto report = decode_report(packet_in("<EDCBAAAAPPPP\xb5"
                                                "A>"));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->encoders, (Counts{0x1234, 0, -1}));
    EXPECT_EQ(report->buttons, 4);
    EXPECT_EQ(report->legs_homed, all_legs);
}

TEST(FalconPacket, WithABadByteIsRefused)
{
    const std::string good = text_of(encode(Report{}));
    ASSERT_TRUE(decode_report(packet_in(good)));
    for (std::size_t i = 0; i < good.size(); ++i) {
        std::string bad = good;
        bad[i] = '<' + (i == 0 ? 1 : 0);
        EXPECT_FALSE(decode_report(packet_in(bad))) << i;
        bad[i] = '@'; // just below 'A': only the unknown byte may be it
        EXPECT_EQ(decode_report(packet_in(bad)).has_value(), i == 14) << i;
    }
    EXPECT_FALSE(decode_report(packet_in("<AAAAAAAAAAAA\xc1"
                                         "A>"))); // an eighth flag
    EXPECT_FALSE(decode_command(packet_in("<AAAAAAAAAAAAQA>")));
}

TEST(FalconPacketFinder, FindsWholePacketsWhateverIsBetweenThem)
{
    PacketFinder finder;
    const std::string one = "<BAAAAAAAAAAAAA>";
    const std::string two = "<CAAAAAAAAAAAAA>";
    EXPECT_EQ(found_in("x>" + one + two + "yy", finder), one + two);
    EXPECT_EQ(finder.skipped(), 4U);
}

TEST(FalconPacketFinder, GoesOnBehindAPacketThatLostBytes)
{
    PacketFinder finder;
    const std::string whole = "<CAAAAAAAAAAAAA>";
    EXPECT_EQ(found_in("<AAAAAAAAAAAA>" + whole, finder), whole); // two are missing
    EXPECT_EQ(finder.skipped(), 14U);
    EXPECT_EQ(found_in("<AAAAAA" + whole, finder), whole); // the end is
    EXPECT_EQ(finder.skipped(), 21U);
    EXPECT_EQ(found_in("<AAAAAAAAAAAAAAA" + whole, finder), whole); // its last byte is wrong
    EXPECT_EQ(finder.skipped(), 37U);
}

} // namespace
} // namespace hapnet::device::falcon

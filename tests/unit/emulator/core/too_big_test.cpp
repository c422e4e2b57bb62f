// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/too_big.hpp"

#include "emulator/core/frame.hpp"
#include "emulator/core/network_bytes.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <span>
#include <utility>
#include <vector>

namespace hapnet::emulator {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::size_t ethernet = 14;

/// From 02::a to 02::b, with these tags and type.
Bytes ethernet_header(const std::vector<unsigned>& type)
{
    Bytes frame;
    for (const unsigned value : {2U, 0U, 0U, 0U, 0U, 0xbU, 2U, 0U, 0U, 0U, 0U, 0xaU}) {
        frame.push_back(static_cast<std::byte>(value));
    }
    for (const unsigned value : type) frame.push_back(static_cast<std::byte>(value));
    return frame;
}

/// UDP from 10.0.0.1 to 10.0.0.2 that must not be fragmented.
Bytes long_v4(std::size_t bytes, const std::vector<unsigned>& type = {8, 0})
{
    Bytes frame = ethernet_header(type);
    const auto header = frame.size();
    frame.resize(header + bytes, std::byte{0x5a});
    const auto packet = std::span{frame}.subspan(header);
    std::ranges::fill(packet.first(20), std::byte{0});
    packet[0] = std::byte{0x45};
    put16(packet, 2, static_cast<std::uint16_t>(bytes));
    packet[6] = std::byte{0x40};
    packet[8] = std::byte{64};
    packet[9] = std::byte{17};
    put16(packet, 12, 0x0a00);
    put16(packet, 14, 1);
    put16(packet, 16, 0x0a00);
    put16(packet, 18, 2);
    return frame;
}

/// UDP from fd00::1 to fd00::2.
Bytes long_v6(std::size_t bytes)
{
    Bytes frame = ethernet_header({0x86, 0xdd});
    frame.resize(ethernet + bytes, std::byte{0x5a});
    const auto packet = std::span{frame}.subspan(ethernet);
    std::ranges::fill(packet.first(40), std::byte{0});
    packet[0] = std::byte{0x60};
    put16(packet, 4, static_cast<std::uint16_t>(bytes - 40));
    packet[6] = std::byte{17};
    packet[7] = std::byte{64};
    put16(packet, 8, 0xfd00);
    put16(packet, 22, 1);
    put16(packet, 24, 0xfd00);
    put16(packet, 38, 2);
    return frame;
}

/// True if its checksums are right: fixing them changes nothing.
bool has_right_checksums(const Bytes& frame)
{
    Bytes fixed = frame;
    fix_checksums(fixed);
    return fixed == frame;
}

TEST(TooBig, TellsTheSenderOfIpv4HowMuchPasses)
{
    const Bytes frame = long_v4(1400);
    const Bytes answer = too_big_answer(frame, 1280);
    ASSERT_EQ(answer.size(), ethernet + 576);
    EXPECT_TRUE(has_right_checksums(answer));
    // To the sender, from the intended receiver.
    EXPECT_EQ(at8(answer, 5), 0xa);
    EXPECT_EQ(at8(answer, 11), 0xb);
    const auto packet = std::span{answer}.subspan(ethernet);
    EXPECT_EQ(at16(packet, 2), 576);
    EXPECT_EQ(at8(packet, 9), 1); // ICMP
    EXPECT_EQ(at16(packet, 14), 2);
    EXPECT_EQ(at16(packet, 18), 1);
    EXPECT_EQ(at16(packet, 20), 0x0304);
    EXPECT_EQ(at16(packet, 26), 1280);
    EXPECT_TRUE(std::ranges::equal(packet.subspan(28), std::span{frame}.subspan(ethernet, 548)));
}

TEST(TooBig, TellsTheSenderOfIpv6HowMuchPasses)
{
    const Bytes frame = long_v6(1500);
    const Bytes answer = too_big_answer(frame, 1400);
    ASSERT_EQ(answer.size(), ethernet + 1280);
    EXPECT_TRUE(has_right_checksums(answer));
    const auto packet = std::span{answer}.subspan(ethernet);
    EXPECT_EQ(at16(packet, 4), 1240);
    EXPECT_EQ(at8(packet, 6), 58); // ICMPv6
    EXPECT_EQ(at16(packet, 22), 2);
    EXPECT_EQ(at16(packet, 38), 1);
    EXPECT_EQ(at16(packet, 40), 0x0200);
    EXPECT_EQ(at16(packet, 44), 0);
    EXPECT_EQ(at16(packet, 46), 1400);
    EXPECT_TRUE(std::ranges::equal(packet.subspan(48), std::span{frame}.subspan(ethernet, 1232)));
}

TEST(TooBig, AnswersWithinTheSameVlan)
{
    const Bytes answer = too_big_answer(long_v4(1400, {0x81, 0, 0x20, 7, 8, 0}), 1280);
    ASSERT_EQ(answer.size(), ethernet + 4 + 576);
    EXPECT_EQ(at16(answer, 12), 0x8100);
    EXPECT_EQ(at16(answer, 14), 0x2007);
    EXPECT_EQ(at16(answer, 16), 0x0800);
    EXPECT_TRUE(has_right_checksums(answer));
}

TEST(TooBig, AnAnswerIsNeverLongerThanWhatPassesThere)
{
    EXPECT_EQ(too_big_answer(long_v4(100), 68).size(), ethernet + 68);
    EXPECT_EQ(too_big_answer(long_v4(1400), 300).size(), ethernet + 300);
    EXPECT_EQ(too_big_answer(long_v6(1281), 1280).size(), ethernet + 1280);
}

TEST(TooBig, SaysNothingWhereARouterWouldNot)
{
    const auto is_silent = [](Bytes frame, std::size_t at, unsigned value) {
        frame[at] = static_cast<std::byte>(value);
        return too_big_answer(frame, 1280).empty();
    };
    const Bytes v4 = long_v4(1400);
    ASSERT_FALSE(is_silent(v4, 0, 2));
    EXPECT_TRUE(too_big_answer(long_v4(1280), 1280).empty()); // it passes
    EXPECT_TRUE(too_big_answer(v4, 67).empty());
    EXPECT_TRUE(is_silent(v4, 0, 3)) << "to a group of machines";
    EXPECT_TRUE(is_silent(v4, ethernet + 6, 0)) << "it may be fragmented";
    EXPECT_TRUE(is_silent(v4, ethernet + 7, 1)) << "a later fragment";
    EXPECT_TRUE(is_silent(v4, ethernet + 16, 224)) << "to a group";
    EXPECT_TRUE(is_silent(v4, ethernet + 12, 255)) << "from no single host";
    auto from_nothing = v4;
    put16(from_nothing, ethernet + 12, 0);
    EXPECT_TRUE(is_silent(from_nothing, ethernet + 15, 0));
    auto icmp = v4;
    icmp[ethernet + 9] = std::byte{1};
    for (const auto& [type, silent] :
         {std::pair{8U, false}, {0U, false}, {3U, true}, {11U, true}}) {
        EXPECT_EQ(is_silent(icmp, ethernet + 20, type), silent) << type;
    }

    const Bytes v6 = long_v6(1400);
    ASSERT_FALSE(is_silent(v6, 0, 2));
    EXPECT_TRUE(too_big_answer(v6, 1279).empty()) << "no sender could obey";
    EXPECT_TRUE(is_silent(v6, ethernet + 24, 0xff)) << "to a group";
    EXPECT_TRUE(is_silent(v6, ethernet + 8, 0xff)) << "from a group";
    auto icmp_v6 = v6;
    icmp_v6[ethernet + 6] = std::byte{58};
    for (const auto& [type, silent] :
         {std::pair{128U, false}, {129U, false}, {1U, true}, {2U, true}}) {
        EXPECT_EQ(is_silent(icmp_v6, ethernet + 40, type), silent) << type;
    }
    Bytes other = v4;
    put16(other, 12, 0x88cc);
    EXPECT_TRUE(too_big_answer(other, 1280).empty());
}

TEST(TooBig, ReadsAnyBytesWithinThem)
{
    for (const Bytes& whole : {long_v4(100), long_v6(100), long_v4(100, {0x81, 0, 0, 5, 8, 0})}) {
        for (std::size_t length = 0; length <= whole.size(); ++length) {
            const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
            const Bytes answer = too_big_answer(part, 68);
            EXPECT_TRUE(answer.empty() || answer.size() <= 18 + 68) << length;
        }
    }
}

} // namespace
} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/packet.hpp"

#include "proto/base/random.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::device::falcon {
namespace {

constexpr int rounds = 20'000;

TEST(FalconPacket, EveryMessageComesBackAsItWasSent)
{
    const base::RandomStream chance = base::Seed{11}.stream("falcon/packets");
    const auto draw = [&](int round, std::uint32_t which) {
        return chance.bits(static_cast<std::uint64_t>(round), which);
    };
    for (int i = 0; i < rounds; ++i) {
        Counts counts{};
        for (std::uint32_t leg = 0; leg < 3; ++leg) {
            counts[leg] = static_cast<std::int16_t>(draw(i, leg));
        }
        const Command command{counts, static_cast<Lights>(draw(i, 3) & 0xeU),
                              (draw(i, 4) & 1U) != 0};
        ASSERT_EQ(decode_command(encode(command)), command);
        const Report report{.encoders = counts,
                            .buttons = static_cast<std::uint8_t>(draw(i, 5) & 0xfU),
                            .legs_homed = static_cast<std::uint8_t>(draw(i, 6) & 0x7U),
                            .rest = static_cast<std::uint8_t>('A' + draw(i, 7) % 100)};
        ASSERT_EQ(decode_report(encode(report)), report);
    }
}

TEST(FalconPacketFinder, FindsEveryPacketThatCameWhole)
{
    // Packets, some with a byte missing or changed, and bytes between them.
    const base::RandomStream chance = base::Seed{12}.stream("falcon/stream");
    PacketFinder finder;
    std::uint64_t fed = 0;
    std::uint64_t whole = 0;
    std::uint64_t found = 0;
    for (int i = 0; i < rounds; ++i) {
        const auto draw = [&](std::uint32_t which) {
            return static_cast<std::size_t>(chance.bits(static_cast<std::uint64_t>(i), which) %
                                            1000);
        };
        const Packet packet = encode(Report{.encoders = {static_cast<std::int16_t>(i), 0, 0}});
        std::vector<std::byte> bytes{packet.begin(), packet.end()};
        const std::size_t place = draw(1) % packet_bytes;
        const bool is_spoilt = draw(0) < 300;
        if (is_spoilt) bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(place));
        if (draw(2) < 200) bytes.insert(bytes.end(), draw(3) % 20, std::byte{'x'});
        whole += is_spoilt ? 0U : 1U;
        for (const std::byte byte : bytes) {
            ++fed;
            if (const auto one = finder.feed(byte)) {
                ++found;
                ASSERT_TRUE(is_spoilt || *one == packet);
            }
        }
    }
    EXPECT_EQ(found, whole);
    EXPECT_GT(whole, 10'000U);
    // All other bytes belong to no packet, except those of an incomplete packet at the end.
    EXPECT_LT(fed - found * packet_bytes - finder.skipped(), packet_bytes);
}

} // namespace
} // namespace hapnet::device::falcon

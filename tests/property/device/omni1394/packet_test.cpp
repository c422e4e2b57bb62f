// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/packet.hpp"
#include "device/omni1394/registers.hpp"
#include "proto/base/random.hpp"

#include <gtest/gtest.h>

namespace hapnet::device::omni1394 {
namespace {

TEST(OmniPacketRoundTrip, GivesBackEveryCommandAndEveryWord)
{
    const auto chance = base::Seed{1394}.stream("omni1394/packets");
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const std::uint64_t bits = chance.bits(i);
        const auto between = [&](std::uint32_t draw, int least, int most) {
            return least + static_cast<int>(
                               chance.below(static_cast<std::uint32_t>(most - least + 1), i, draw));
        };
        const HostPacket host{
            .motors = {between(1, -2047, 2047), between(2, -2047, 2047), between(3, -2047, 2047)},
            .motors_on = (bits & 1U) != 0,
            .dock_light_flashes = (bits & 2U) != 0,
            .dock_light_flashes_fast = (bits & 4U) != 0};
        ASSERT_EQ(decode_host(encode(host)), host);
        DevicePacket word;
        for (const int axis : {0, 1, 2}) {
            const auto at = static_cast<std::size_t>(axis);
            word.counts[axis] = between(4 + static_cast<std::uint32_t>(axis), -32768, 32767);
            word.gimbal[at] = static_cast<std::uint16_t>(bits >> (16U * at));
            word.gimbal_opposite[at] = static_cast<std::uint16_t>(~word.gimbal[at]);
        }
        word.number = static_cast<std::uint8_t>(bits >> 8U);
        word.buttons = static_cast<std::uint8_t>(bits >> 20U & 3U);
        word.docked = (bits & 8U) != 0;
        word.message = static_cast<std::uint32_t>(bits >> 24U);
        word.clock = static_cast<std::uint32_t>(bits >> 32U);
        ASSERT_EQ(decode_device(encode(word)), word);
    }
}

TEST(OmniSerial, HasElevenDigitsWhateverTheRegisterHolds)
{
    const auto chance = base::Seed{1394}.stream("omni1394/serials");
    for (std::uint64_t i = 0; i < 20000; ++i) {
        const auto quadlet = static_cast<std::uint32_t>(chance.bits(i));
        const std::string serial = serial_of(quadlet);
        ASSERT_EQ(serial.size(), 11U);
        // The bits around the five fields have no meaning.
        ASSERT_EQ(serial_of(quadlet ^ 0xfc000001U), serial);
        ASSERT_NE(serial_of(quadlet ^ 0x00000002U), serial);
    }
}

} // namespace
} // namespace hapnet::device::omni1394

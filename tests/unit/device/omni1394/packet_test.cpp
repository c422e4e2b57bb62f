// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/packet.hpp"
#include "device/omni1394/registers.hpp"

#include <gtest/gtest.h>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::device::omni1394 {
namespace {

std::vector<std::byte> from_hex(std::string_view text)
{
    std::vector<std::byte> bytes;
    std::string digits;
    for (const char c : text) {
        if (c == ' ') continue;
        digits += c;
        if (digits.size() < 2) continue;
        bytes.push_back(std::byte(std::stoi(digits, nullptr, 16)));
        digits.clear();
    }
    return bytes;
}

std::vector<std::byte> bytes_of(const HostPacket& packet)
{
    const HostBytes bytes = encode(packet);
    return {bytes.begin(), bytes.end()};
}

// The first packet is that of a program of the University of Twente, and so is the second with both
// lights. The others follow from the meaning of the bits.
TEST(OmniPacket, IsWrittenAsTheDescriptionsHaveIt)
{
    EXPECT_EQ(bytes_of({}), from_hex("ff07 ff07 ff07 c053 00000000 00000000"));
    EXPECT_EQ(bytes_of({.dock_light_flashes = true, .dock_light_flashes_fast = true}),
              from_hex("ff07 ff07 ff07 c353 00000000 00000000"));
    EXPECT_EQ(bytes_of({.motors = {1, -2, 256}, .motors_on = true}),
              from_hex("0008 fd07 ff08 c853 00000000 00000000"));
}

TEST(OmniPacket, ClampsMotorsToTwelveBits)
{
    EXPECT_EQ(bytes_of({.motors = {100000, -100000, 2047}}),
              from_hex("fe0f 0000 fe0f c053 00000000 00000000"));
}

TEST(OmniPacket, IsReadAsTheDescriptionsHaveIt)
{
    // Not observed, but laid out by hand. Undocked, the second button down.
    const auto bytes = from_hex("00001e00 0100 feff e80a 2001 4002 6003 0000 2a fd 0710 "
                                "c0fe a0fd 80fc 4657 0000 78563412 0000 0000 efbeadde");
    const auto packet = decode_device(bytes);
    ASSERT_TRUE(packet);
    EXPECT_EQ(packet->counts, omni::Counts(1, -2, 2792));
    EXPECT_EQ(packet->gimbal[2], 0x0360);
    EXPECT_EQ(packet->gimbal_opposite[0], 0xfec0);
    EXPECT_EQ(packet->number, 42);
    EXPECT_EQ(packet->buttons, 0b10);
    EXPECT_FALSE(packet->docked);
    EXPECT_EQ(packet->message, 0x12345678U);
    EXPECT_EQ(packet->clock, 0xdeadbeefU);
}

TEST(OmniPacket, SaysThatTheStylusIsDockedAndButtonsAreDownByBitsThatAreZero)
{
    DeviceBytes bytes = encode(DevicePacket{});
    bytes[19] = std::byte{0x00};
    EXPECT_TRUE(decode_device(bytes)->docked);
    EXPECT_EQ(decode_device(bytes)->buttons, 0b11);
    bytes[19] = std::byte{0x07};
    EXPECT_FALSE(decode_device(bytes)->docked);
    EXPECT_EQ(decode_device(bytes)->buttons, 0);
}

TEST(OmniPacket, MayBeLongerThanWhatIsUsedButNotShorterAndBeginsAsItDoes)
{
    const DeviceBytes whole = encode(DevicePacket{.message = 7});
    std::vector<std::byte> bytes{whole.begin(), whole.end()};
    bytes.resize(64);
    EXPECT_EQ(decode_device(bytes)->message, 7U);
    EXPECT_FALSE(decode_device(std::span{bytes}.first(43)));
    EXPECT_FALSE(decode_device({}));
    bytes[2] = std::byte{0x1f};
    EXPECT_FALSE(decode_device(bytes));
}

TEST(OmniRegisters, HoldTheSerialNumberThatIsPrintedOnTheDevice)
{
    // Observed by a program of the University of Twente, which took it for a type. Last bit: 0.
    EXPECT_EQ(quadlet_of(from_hex("83a6d80e")), 0x83a6d80eU);
    EXPECT_EQ(serial_of(0x83a6d80e), "70427300007");
    EXPECT_EQ(serial_of(0x80000001), "00000000000");
    EXPECT_EQ(serial_of(0xffffffff), "71531701023");
}

} // namespace
} // namespace hapnet::device::omni1394

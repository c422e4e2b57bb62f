// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::device::falcon {

// The packets between a Falcon and its host once its firmware runs: 16 bytes in each direction, the
// host's packet first. A packet is '<', three numbers of 16 bits in four nibbles each, the least
// significant first, two bytes of flags, '>'. 'A' is added to each nibble and flag. Known from
// libnifalcon (src/firmware/FalconFirmwareNovintSDK.cpp), not from the device's maker.

inline constexpr std::size_t packet_bytes = 16;
using Packet = std::array<std::byte, packet_bytes>;
using Counts = std::array<std::int16_t, 3>; // one for each leg

/// The lights around the logo, as libnifalcon names them.
enum class Lights : std::uint8_t { none = 0x0, green = 0x2, blue = 0x4, red = 0x8 };

/// A packet from the host.
struct Command {
    Counts motors{};
    Lights lights = Lights::none;
    bool home = false; // the legs must find the ends of their reach

    friend bool operator==(const Command&, const Command&) = default;
};

/// The greatest magnitude of a motor value.
inline constexpr int motor_max = 4096;

/// A packet from the device.
struct Report {
    Counts encoders{};
    std::uint8_t buttons = 0;    // bit 0 plus, 1 forward, 2 centre, 3 minus
    std::uint8_t legs_homed = 0; // bits 0 to 2, one for each leg
    std::uint8_t rest = 'A';     // the last byte before '>': meaning unknown

    friend bool operator==(const Report&, const Report&) = default;
};
inline constexpr std::uint8_t all_legs = 0x7;

[[nodiscard]] Packet encode(const Command& command);
[[nodiscard]] Packet encode(const Report& report); // for test doubles of the device
/// Returns nullopt for bytes that are no packet. Accepted bytes encode to the same bytes again.
[[nodiscard]] std::optional<Report> decode_report(std::span<const std::byte, packet_bytes> bytes);
[[nodiscard]] std::optional<Command> decode_command(std::span<const std::byte, packet_bytes> bytes);

/// Finds packets in a stream of bytes, some of which may be missing or wrong. It finds each packet
/// whose 16 bytes came without interruption, whatever is around it.
class PacketFinder {
public:
    /// Takes one byte. Returns the packet that this byte completes, if any.
    [[nodiscard]] std::optional<Packet> feed(std::byte byte);

    /// Returns the number of bytes that belonged to no packet.
    [[nodiscard]] std::uint64_t skipped() const { return skipped_; }

private:
    Packet packet_{};
    std::size_t size_ = 0;
    std::uint64_t skipped_ = 0;
};

} // namespace hapnet::device::falcon

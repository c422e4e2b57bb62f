// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace hapnet::device::omni1394 {

// The registers of the FireWire Omni; sources as in packet.hpp. Quadlets are big-endian on the bus.

inline constexpr std::uint64_t to_device_channel_register = 0x1000; // 1 byte
inline constexpr std::uint64_t to_host_channel_register = 0x1001;   // 1 byte
/// 1 byte; bit 3: the device sends and listens.
inline constexpr std::uint64_t control_register = 0x1087;
inline constexpr std::byte control_streaming_bit{0x08};
/// 4 bytes of unknown purpose. One of the open programs needs to write them. With another program,
/// two devices at once worked only without this.
inline constexpr std::uint64_t dubious_register = 0x20010;
inline constexpr std::array<std::byte, 4> dubious_value{std::byte{0x00}, std::byte{0x00},
                                                        std::byte{0x0f}, std::byte{0xf8}};
/// A quadlet: the vendor's number, which identifies the device; its configuration ROM has no model.
inline constexpr std::uint64_t model_register = 0x1006000c;
inline constexpr std::uint32_t model_value = 0x000b9900;
inline constexpr std::uint32_t vendor_id = 0x000b99;
/// A quadlet: see serial_of().
inline constexpr std::uint64_t serial_register = 0x10060010;

/// Returns the quadlet in four bytes of the bus.
[[nodiscard]] std::uint32_t quadlet_of(std::span<const std::byte> bytes);

/// Returns the serial number as it is printed on the device, 11 digits: a date and a number. It
/// consists of five fields of the quadlet from bit 25 down, 3, 4, 5, 3 and 10 bits wide, printed
/// with 1, 2, 2, 1 and 5 digits. The other bits have no known meaning.
[[nodiscard]] std::string serial_of(std::uint32_t quadlet);

} // namespace hapnet::device::omni1394

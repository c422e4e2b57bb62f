// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/omni/encoders.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::device::omni1394 {

// The isochronous packets of the FireWire Omni, little-endian, as three open programs describe
// them: ytsutano/raw_omni, scottsharris/phantom-drivers (University of Twente) and
// jdrew1303/ros_geomagic_touch_phantom_omni. They are read for facts; nothing is copied.

/// A packet from the computer to the device.
struct HostPacket {
    /// Motor values, -2047 to 2047. On the wire each has 12 bits around 0x07ff.
    glm::ivec3 motors{0};
    bool motors_on = false;
    bool dock_light_flashes = false;
    bool dock_light_flashes_fast = false; // together with dock_light_flashes: steady light

    friend bool operator==(const HostPacket&, const HostPacket&) = default;
};
inline constexpr std::size_t host_packet_bytes = 16;
inline constexpr int motor_max = 2047;
using HostBytes = std::array<std::byte, host_packet_bytes>;

/// Encodes a packet. Motor values beyond their range are clamped.
[[nodiscard]] HostBytes encode(const HostPacket& packet);
/// Decodes a packet. Returns nullopt for bytes that encode() never returns.
[[nodiscard]] std::optional<HostPacket> decode_host(std::span<const std::byte> bytes);

/// A packet from the device.
struct DevicePacket {
    omni::Counts counts{0};
    std::array<std::uint16_t, 3> gimbal{};          // potentiometers; the low 5 bits are noise
    std::array<std::uint16_t, 3> gimbal_opposite{}; // the same potentiometers from the other end
    std::uint8_t number = 0;                        // number of the packet
    std::uint8_t buttons = 0;                       // bits 0 and 1, 1: down
    bool docked = false;
    std::uint32_t message = 0; // message count, which also grows while no program listens
    std::uint32_t clock = 0;   // time in an unknown unit

    friend bool operator==(const DevicePacket&, const DevicePacket&) = default;
};
inline constexpr std::size_t device_packet_bytes_min = 44;
inline constexpr std::size_t device_packet_bytes_max = 64;
using DeviceBytes = std::array<std::byte, device_packet_bytes_min>;

/// Encodes a packet, for test doubles of the device.
[[nodiscard]] DeviceBytes encode(const DevicePacket& packet);
/// Returns nullopt for bytes that are too short or do not begin as every device packet does.
[[nodiscard]] std::optional<DevicePacket> decode_device(std::span<const std::byte> bytes);

} // namespace hapnet::device::omni1394

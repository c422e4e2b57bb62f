// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/packet.hpp"

#include "proto/base/bytes.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

namespace hapnet::device::omni1394 {

namespace {

constexpr int motor_zero = 0x07ff;
constexpr std::uint16_t status_base = 0x53c0; // purpose unknown
constexpr std::uint16_t flash_bit = 0x0001;
constexpr std::uint16_t fast_flash_bit = 0x0002;
constexpr std::uint16_t motors_on_bit = 0x0008;
constexpr std::uint16_t known_bits = flash_bit | fast_flash_bit | motors_on_bit;

constexpr std::uint32_t device_header = 0x001e0000;
constexpr std::uint8_t button_bits = 0x03; // 0: down
constexpr std::uint8_t undocked_bit = 0x04;
// Words of unknown meaning, with the values that were observed.
constexpr std::uint16_t seen_at_20 = 0x1007;
constexpr std::uint16_t seen_at_28 = 0x5746;

std::int16_t signed_of(std::uint16_t value) { return std::bit_cast<std::int16_t>(value); }

void read(base::ByteReader& in, std::array<std::uint16_t, 3>& values)
{
    for (std::uint16_t& value : values) value = in.u16();
}

} // namespace

HostBytes encode(const HostPacket& packet)
{
    HostBytes bytes{};
    base::ByteWriter out{bytes};
    for (const int axis : {0, 1, 2}) {
        const int motor = std::clamp(packet.motors[axis], -motor_max, motor_max);
        out.u16(static_cast<std::uint16_t>(motor_zero + motor));
    }
    unsigned status = status_base;
    if (packet.dock_light_flashes) status |= flash_bit;
    if (packet.dock_light_flashes_fast) status |= fast_flash_bit;
    if (packet.motors_on) status |= motors_on_bit;
    out.u16(static_cast<std::uint16_t>(status));
    out.u64(0);
    return bytes;
}

std::optional<HostPacket> decode_host(std::span<const std::byte> bytes)
{
    base::ByteReader in{bytes};
    HostPacket packet;
    for (const int axis : {0, 1, 2}) packet.motors[axis] = in.u16() - motor_zero;
    const std::uint16_t status = in.u16();
    const bool ends_in_zeros = in.u64() == 0;
    packet.dock_light_flashes = (status & flash_bit) != 0;
    packet.dock_light_flashes_fast = (status & fast_flash_bit) != 0;
    packet.motors_on = (status & motors_on_bit) != 0;
    bool in_range = true;
    for (const int axis : {0, 1, 2}) {
        in_range =
            in_range && packet.motors[axis] >= -motor_max && packet.motors[axis] <= motor_max;
    }
    if (!in.complete() || !ends_in_zeros || !in_range) return std::nullopt;
    if ((status & ~unsigned{known_bits}) != status_base) return std::nullopt;
    return packet;
}

DeviceBytes encode(const DevicePacket& packet)
{
    DeviceBytes bytes{};
    base::ByteWriter out{bytes};
    out.u32(device_header);
    for (const int axis : {0, 1, 2}) out.u16(static_cast<std::uint16_t>(packet.counts[axis]));
    for (const std::uint16_t value : packet.gimbal) out.u16(value);
    out.u16(0);
    out.u8(packet.number);
    const unsigned switches =
        (~unsigned{packet.buttons} & button_bits) | (packet.docked ? 0U : unsigned{undocked_bit});
    out.u8(static_cast<std::uint8_t>(switches));
    out.u16(seen_at_20);
    for (const std::uint16_t value : packet.gimbal_opposite) out.u16(value);
    out.u16(seen_at_28);
    out.u16(0);
    out.u32(packet.message);
    out.u32(0);
    out.u32(packet.clock);
    return bytes;
}

std::optional<DevicePacket> decode_device(std::span<const std::byte> bytes)
{
    if (bytes.size() > device_packet_bytes_max) return std::nullopt;
    base::ByteReader in{bytes};
    DevicePacket packet;
    const std::uint32_t header = in.u32();
    for (const int axis : {0, 1, 2}) packet.counts[axis] = signed_of(in.u16());
    read(in, packet.gimbal);
    std::ignore = in.u16();
    packet.number = in.u8();
    const std::uint8_t switches = in.u8();
    packet.buttons = static_cast<std::uint8_t>(~unsigned{switches} & button_bits);
    packet.docked = (switches & undocked_bit) == 0;
    std::ignore = in.u16();
    read(in, packet.gimbal_opposite);
    std::ignore = in.u32();
    packet.message = in.u32();
    std::ignore = in.u32();
    packet.clock = in.u32();
    if (!in.ok() || header != device_header) return std::nullopt;
    return packet;
}

} // namespace hapnet::device::omni1394

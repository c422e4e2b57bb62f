// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::emulator {

// Numbers in packets, most significant byte first.

[[nodiscard]] inline std::uint8_t at8(std::span<const std::byte> bytes, std::size_t at)
{
    return std::to_integer<std::uint8_t>(bytes[at]);
}

[[nodiscard]] inline std::uint16_t at16(std::span<const std::byte> bytes, std::size_t at)
{
    return static_cast<std::uint16_t>(at8(bytes, at) << 8 | at8(bytes, at + 1));
}

inline void put16(std::span<std::byte> bytes, std::size_t at, std::uint16_t value)
{
    bytes[at] = static_cast<std::byte>(value >> 8);
    bytes[at + 1] = static_cast<std::byte>(value & 0xff);
}

} // namespace hapnet::emulator

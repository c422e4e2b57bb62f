// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/registers.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::device::omni1394 {

std::uint32_t quadlet_of(std::span<const std::byte> bytes)
{
    std::uint32_t value = 0;
    for (const std::byte byte : bytes.first(4)) {
        value = value << 8U | std::to_integer<std::uint32_t>(byte);
    }
    return value;
}

std::string serial_of(std::uint32_t quadlet)
{
    const auto field = [quadlet](unsigned lowest_bit, unsigned bits) {
        return quadlet >> lowest_bit & ((1U << bits) - 1U);
    };
    return fmt::format("{:01}{:02}{:02}{:01}{:05}", field(23, 3), field(19, 4), field(14, 5),
                       field(11, 3), field(1, 10));
}

} // namespace hapnet::device::omni1394

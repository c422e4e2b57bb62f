// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/spacemouse_report.hpp"

#include "device/usb_ids.hpp"

#include <cstdlib>

namespace hapnet::device::hid {

namespace {

constexpr std::size_t three_numbers = 6;
constexpr std::size_t six_numbers = 12;

int number_at(std::span<const std::byte> data, std::size_t offset)
{
    const auto low = std::to_integer<unsigned>(data[offset]);
    const auto high = std::to_integer<unsigned>(data[offset + 1]);
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(low | (high << 8U)));
}

} // namespace

std::optional<SpaceMouseReport> read_spacemouse(std::span<const std::byte> report)
{
    if (report.empty()) return std::nullopt;
    const auto data = report.subspan(1);
    SpaceMouseReport word;
    switch (std::to_integer<unsigned>(report[0])) {
    case 1: {
        // Wireless models append data that are not used here.
        if (data.size() != three_numbers && data.size() < six_numbers) return std::nullopt;
        const glm::ivec3 deflection{number_at(data, 0), number_at(data, 2), number_at(data, 4)};
        for (const int axis : {0, 1, 2}) {
            if (std::abs(deflection[axis]) > deflection_valid_max) return std::nullopt;
        }
        word.deflection = deflection;
        return word;
    }
    case 3:
        if (data.empty()) return std::nullopt;
        word.buttons = std::to_integer<std::uint8_t>(data[0]);
        return word;
    default: return word;
    }
}

std::string_view spacemouse_name(std::uint16_t vendor, std::uint16_t product)
{
    const UsbId* const id = find_usb_id(vendor, product);
    return id != nullptr && id->kind == UsbKind::spacemouse ? id->name : "";
}

} // namespace hapnet::device::hid

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/spacemouse_report.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace hapnet::device::hid {

namespace {

struct Model {
    std::uint16_t vendor;
    std::uint16_t product;
    std::string_view name;
};

// From the list of spacenavd and of other public drivers.
constexpr std::array models{
    Model{0x046d, 0xc603, "SpaceMouse Plus XT"},
    Model{0x046d, 0xc605, "CADman"},
    Model{0x046d, 0xc606, "SpaceMouse Classic"},
    Model{0x046d, 0xc621, "SpaceBall 5000"},
    Model{0x046d, 0xc623, "SpaceTraveler"},
    Model{0x046d, 0xc625, "SpacePilot"},
    Model{0x046d, 0xc626, "SpaceNavigator"},
    Model{0x046d, 0xc627, "SpaceExplorer"},
    Model{0x046d, 0xc628, "SpaceNavigator for Notebooks"},
    Model{0x046d, 0xc629, "SpacePilot Pro"},
    Model{0x046d, 0xc62b, "SpaceMouse Pro"},
    Model{0x256f, 0xc62e, "SpaceMouse Wireless (cable)"},
    Model{0x256f, 0xc62f, "SpaceMouse Wireless (receiver)"},
    Model{0x256f, 0xc631, "SpaceMouse Pro Wireless (cable)"},
    Model{0x256f, 0xc632, "SpaceMouse Pro Wireless (receiver)"},
    Model{0x256f, 0xc633, "SpaceMouse Enterprise"},
    Model{0x256f, 0xc635, "SpaceMouse Compact"},
    Model{0x256f, 0xc636, "SpaceMouse Module"},
    Model{0x256f, 0xc638, "SpaceMouse Pro Wireless (Bluetooth)"},
    Model{0x256f, 0xc63a, "SpaceMouse Wireless (Bluetooth)"},
    Model{0x256f, 0xc652, "3Dconnexion Universal Receiver"},
};

constexpr std::size_t three_numbers = 6;
constexpr std::size_t six_numbers = 12;

int number_at(std::span<const std::byte> data, std::size_t offset)
{
    const auto low = std::to_integer<unsigned>(data[offset]);
    const auto high = std::to_integer<unsigned>(data[offset + 1]);
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(low | (high << 8U)));
}

} // namespace

std::optional<SpaceMouseWord> read_spacemouse(std::span<const std::byte> report)
{
    if (report.empty()) return std::nullopt;
    const auto data = report.subspan(1);
    SpaceMouseWord word;
    switch (std::to_integer<unsigned>(report[0])) {
    case 1: {
        // Wireless ones append what is none of our business.
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
    const auto* const found = std::find_if(models.begin(), models.end(), [&](const Model& model) {
        return model.vendor == vendor && model.product == product;
    });
    return found == models.end() ? "" : found->name;
}

} // namespace hapnet::device::hid

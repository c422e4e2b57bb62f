// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace hapnet::device {

/// The kind of device node through which the backend accesses a USB device.
enum class UsbNode : std::uint8_t { usb, hidraw, tty };

enum class UsbKind : std::uint8_t { falcon, force_board, spacemouse, touch, force_dimension };

/// Stands for all products of a vendor.
inline constexpr std::uint16_t any_product = 0;

/// A device that is identified by its numbers. udev/60-hapnet.rules grants access to exactly these
/// to their user.
struct UsbId {
    UsbKind kind;
    UsbNode node;
    std::uint16_t vendor;
    std::uint16_t product;
    std::string_view name;
};

/// The numbers of the SpaceMouses are from the list of spacenavd and of other public drivers, and
/// those of the Touches from public udev rules. For Force Dimension only the vendor's number is
/// known.
inline constexpr std::array usb_ids{
    UsbId{UsbKind::falcon, UsbNode::usb, 0x0403, 0xcb48, "Novint Falcon"},
    UsbId{UsbKind::force_board, UsbNode::hidraw, 0x1209, 0xffb0, "OpenFFBoard"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc603, "SpaceMouse Plus XT"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc605, "CADman"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc606, "SpaceMouse Classic"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc621, "SpaceBall 5000"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc623, "SpaceTraveler"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc625, "SpacePilot"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc626, "SpaceNavigator"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc627, "SpaceExplorer"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc628, "SpaceNavigator for Notebooks"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc629, "SpacePilot Pro"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x046d, 0xc62b, "SpaceMouse Pro"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x256f, 0xc62e, "SpaceMouse Wireless (cable)"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x256f, 0xc62f, "SpaceMouse Wireless (receiver)"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x256f, 0xc631, "SpaceMouse Pro Wireless (cable)"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x256f, 0xc632,
          "SpaceMouse Pro Wireless (receiver)"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x256f, 0xc633, "SpaceMouse Enterprise"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x256f, 0xc635, "SpaceMouse Compact"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x256f, 0xc636, "SpaceMouse Module"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x256f, 0xc638,
          "SpaceMouse Pro Wireless (Bluetooth)"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x256f, 0xc63a, "SpaceMouse Wireless (Bluetooth)"},
    UsbId{UsbKind::spacemouse, UsbNode::hidraw, 0x256f, 0xc652, "3Dconnexion Universal Receiver"},
    UsbId{UsbKind::touch, UsbNode::tty, 0x0301, 0x2988, "Touch"},
    UsbId{UsbKind::touch, UsbNode::tty, 0x2988, 0x0302, "Touch"},
    UsbId{UsbKind::touch, UsbNode::hidraw, 0x2988, 0x0304, "Touch"},
    UsbId{UsbKind::force_dimension, UsbNode::usb, 0x1451, any_product, "Force Dimension"},
};

/// Returns the entry with these numbers; nullptr: unknown.
[[nodiscard]] constexpr const UsbId* find_usb_id(std::uint16_t vendor, std::uint16_t product)
{
    const auto* const found = std::find_if(usb_ids.begin(), usb_ids.end(), [&](const UsbId& id) {
        return id.vendor == vendor && (id.product == product || id.product == any_product);
    });
    return found == usb_ids.end() ? nullptr : found;
}

} // namespace hapnet::device

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>

namespace hapnet::device::hid {

/// The used parts of a SpaceMouse's report, as public drivers read it (spacenavd and others).
/// Report 1 is the translation in three little-endian 16-bit numbers, or translation and rotation
/// in six. Report 2 is the rotation, for models that send it separately. Report 3 has a bit for
/// each button.
struct SpaceMouseReport {
    /// About -350 to 350 along the device's axes: x right, y toward the user, z down.
    std::optional<glm::ivec3> deflection{};
    std::optional<std::uint8_t> buttons{}; // the first eight buttons
};

/// The greatest value that a SpaceMouse reports.
inline constexpr int deflection_valid_max = 1000;

/// Returns nullopt for invalid bytes. A report with another number gives an empty result.
[[nodiscard]] std::optional<SpaceMouseReport> read_spacemouse(std::span<const std::byte> report);

/// Returns the name of the SpaceMouse; "" for a USB identity that is not a SpaceMouse's.
[[nodiscard]] std::string_view spacemouse_name(std::uint16_t vendor, std::uint16_t product);

} // namespace hapnet::device::hid

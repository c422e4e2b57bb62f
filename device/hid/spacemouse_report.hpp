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

/// The parts of a SpaceMouse's report that matter here, as public drivers read it (spacenavd and
/// others): report 1 is the translation in three little-endian 16-bit numbers, or translation and
/// rotation in six; report 2 is the rotation of those that send it apart; report 3 is a bit for
/// each button.
struct SpaceMouseReport {
    /// About -350 to 350 along the device's axes: x right, y toward the user, z down.
    std::optional<glm::ivec3> deflection{};
    std::optional<std::uint8_t> buttons{}; // the first eight buttons
};

/// No SpaceMouse reports more than this.
inline constexpr int deflection_valid_max = 1000;

/// Returns nullopt for nonsense. A report of another number gives an empty one.
[[nodiscard]] std::optional<SpaceMouseReport> read_spacemouse(std::span<const std::byte> report);

/// Returns the name of the SpaceMouse; "" for a USB identity that is not a SpaceMouse's.
[[nodiscard]] std::string_view spacemouse_name(std::uint16_t vendor, std::uint16_t product);

} // namespace hapnet::device::hid

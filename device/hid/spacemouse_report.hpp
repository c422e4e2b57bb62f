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

/// What a report of a SpaceMouse tells that matters here. As public drivers read it (spacenavd and
/// others): report 1 is the translation in three little-endian 16-bit numbers, or translation and
/// rotation in six; report 2 is the rotation of those that send it apart; report 3 is a bit for
/// each button.
struct SpaceMouseWord {
    /// About -350 to 350 along the device's axes: x right, y toward the user, z down.
    std::optional<glm::ivec3> deflection{};
    std::optional<std::uint8_t> buttons{}; // the first eight
};

/// More than that no SpaceMouse says.
inline constexpr int deflection_valid_max = 1000;

/// nullopt: nonsense. A report that is none of the three is a word that says nothing.
[[nodiscard]] std::optional<SpaceMouseWord> read_spacemouse(std::span<const std::byte> report);

/// Its name; "" where the USB identity is no SpaceMouse's.
[[nodiscard]] std::string_view spacemouse_name(std::uint16_t vendor, std::uint16_t product);

} // namespace hapnet::device::hid

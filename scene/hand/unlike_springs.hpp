// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/pressed_modes.hpp"

#include <optional>

namespace hapnet::scene {

/// Two springs of any stiffness and damping each that press a body throughout a tick. Their depths
/// have no modes of their own as PressedModes has, so both go as one Taylor's series, to rounding.
struct UnlikeSprings {
    Two own{}; // how a depth responds to its own force, 1/kg
    double mutual = 0.0;
    Two stiffness{}, damping{};
    double tick = 0.0;

    /// Returns nullopt when the tick is long for the springs.
    [[nodiscard]] std::optional<PressedModes::Outcome>
    outcome(const PressedModes::Start& start) const;
};

} // namespace hapnet::scene

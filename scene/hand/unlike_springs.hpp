// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/hand/pressed_modes.hpp"

#include <optional>

namespace hapnet::scene {

/// Two springs, each with its own stiffness and damping, that press a body throughout a tick.
/// Unlike those of PressedModes, their depths have no separate modes, so both are computed as one
/// Taylor's series, to rounding.
struct UnlikeSprings {
    Two own{}; // response of a depth to its own force, 1/kg
    double mutual = 0.0;
    Two stiffness{}, damping{};
    double tick = 0.0;

    /// Returns nullopt when the tick is too long for such stiff springs.
    [[nodiscard]] std::optional<PressedModes::Outcome>
    outcome(const PressedModes::Start& start) const;
};

} // namespace hapnet::scene

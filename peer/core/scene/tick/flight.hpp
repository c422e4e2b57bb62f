// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/scene/stage.hpp"

namespace hapnet::scene {

/// Bodies that nothing touches: exact parabolas, and rotations that keep the angular momentum.
class FlightTick {
public:
    FlightTick(const Description& description, const Frozen& frozen, const Stage& stage);

    void tick(const Frozen& frozen, Stage& stage);
    void disturbed(Stage& stage, BodyId body);
};

} // namespace hapnet::scene

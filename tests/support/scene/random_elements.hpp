// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/scene/random_play.hpp"

namespace hapnet::test {

/// Makes some of a scene's fixed bodies kinematic, and adds planes that hands feel, fields of force
/// and springs and friction of bodies' and hands' own; each in some scenes.
void add_elements(std::uint64_t seed, RandomPlay& play);

/// Adds pushes at points, torques and blows, and drives and moves of kinematic bodies.
void add_actions(std::uint64_t seed, RandomPlay& play);

} // namespace hapnet::test

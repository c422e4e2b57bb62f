// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/scene/random_play.hpp"

namespace hapnet::test {

/// Makes some of a scene's fixed bodies kinematic. Adds felt planes, fields of force, and springs
/// and friction of single bodies and hands; each in some scenes.
void add_elements(std::uint64_t seed, RandomPlay& play);

/// Adds pushes at points, torques and blows, and drives and moves of kinematic bodies.
void add_actions(std::uint64_t seed, RandomPlay& play);

} // namespace hapnet::test

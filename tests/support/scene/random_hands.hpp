// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/scene/random_play.hpp"

namespace hapnet::test {

/// The hands' inputs for `ticks` ticks, near the bodies' first places. Each hand moves to a body's
/// face, edge, corner or inside at a speed of its own, and sometimes jumps elsewhere. One scene in
/// four has no hand and no pushes.
[[nodiscard]] std::vector<TickInputs> random_inputs(std::uint64_t seed, const RandomPlay& play,
                                                    std::uint32_t ticks);

} // namespace hapnet::test

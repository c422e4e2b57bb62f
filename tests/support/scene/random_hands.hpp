// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/scene/random_play.hpp"

namespace hapnet::test {

/// What hands do in so many ticks around where the scene's bodies began: each makes for a body's
/// face, edge, corner or inside at a speed of its own, and now and then is suddenly elsewhere. In
/// one scene of four nobody pushes and no hand is there.
[[nodiscard]] std::vector<TickInputs> random_inputs(std::uint64_t seed, const RandomPlay& play,
                                                    std::uint32_t ticks);

} // namespace hapnet::test

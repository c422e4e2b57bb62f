// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/scene/hip/advance.hpp"

#include "peer/core/scene/hip/passage.hpp"

namespace hapnet::scene {

void advance(MovingBody& body, const Answer& answer, std::span<const HipSpring> springs,
             std::span<HipWork> work, double tick)
{
    for (HipWork& each : work) each = {};
    if (springs.empty()) {
        advance_freely(body, answer, tick);
        return;
    }
    Passage passage{body, answer, tick};
    for (std::size_t i = 0; i < springs.size() && i < 2; ++i) passage.add(springs[i], work[i]);
    if (!passage.pass()) __builtin_abort();
}

} // namespace hapnet::scene

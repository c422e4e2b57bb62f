// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/state.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace hapnet::scene {

Scales scales_of(const WorldConfig& config, const Bodies& bodies)
{
    double size = std::numeric_limits<double>::infinity();
    double least = size;
    for (Slot slot = 0; slot < bodies.size(); ++slot) {
        const glm::dvec3& half = bodies.properties[slot].half;
        least = std::min(least, std::min(half.x, std::min(half.y, half.z)));
        if (slot < bodies.movable) size = least;
    }
    constexpr double hardly = 1e-6;
    const double fall = config.tick * std::sqrt(glm::dot(config.gravity, config.gravity));
    return {config.tick,      size, least, fall, std::max(fall, hardly * size / config.tick),
            1.0 / config.tick};
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/scene/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace hapnet::bench {

namespace {

struct Placed {
    glm::dvec3 centre{0.0};
    glm::dmat3 axes{1.0};
    glm::dvec3 half{0.0};
    bool movable = true;

    /// Half the length of its shadow along a direction.
    [[nodiscard]] double reach(const glm::dvec3& direction) const
    {
        return glm::dot(half, glm::abs(direction * axes));
    }
};

/// The depth to which two boxes overlap along a direction; negative when they are apart.
double overlap_along(const glm::dvec3& direction, const Placed& a, const Placed& b)
{
    const double length = glm::length(direction);
    const double between = std::abs(glm::dot(b.centre - a.centre, direction));
    return (a.reach(direction) + b.reach(direction) - between) / length;
}

double overlap_of(const Placed& a, const Placed& b)
{
    const glm::dvec3 between = b.centre - a.centre;
    const double radii = glm::length(a.half) + glm::length(b.half);
    if (glm::dot(between, between) >= radii * radii) return 0.0;
    constexpr double parallel = 1e-6; // such edges have no plane of their own
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        least = std::min({least, overlap_along(a.axes[i], a, b), overlap_along(b.axes[i], a, b)});
        for (int j = 0; j < 3; ++j) {
            const glm::dvec3 across = glm::cross(a.axes[i], b.axes[j]);
            if (glm::dot(across, across) < parallel) continue;
            least = std::min(least, overlap_along(across, a, b));
        }
        if (least <= 0.0) return 0.0;
    }
    return least;
}

} // namespace

double deepest_overlap(const scene::Description& scene, const Engine& engine)
{
    std::vector<Placed> boxes;
    for (scene::BodyId i = 0; i < scene.bodies.size(); ++i) {
        const scene::BodyState state = engine.state(i);
        boxes.push_back({state.position.value, glm::mat3_cast(state.orientation),
                         scene.bodies[i].half, scene.bodies[i].movable});
    }
    double deepest = 0.0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        for (const auto& plane : scene.planes) {
            if (!boxes[i].movable) continue;
            const double above = glm::dot(boxes[i].centre, plane.normal) - plane.offset_m;
            deepest = std::max(deepest, boxes[i].reach(plane.normal) - above);
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (!boxes[i].movable && !boxes[j].movable) continue;
            deepest = std::max(deepest, overlap_of(boxes[i], boxes[j]));
        }
    }
    return deepest;
}

} // namespace hapnet::bench

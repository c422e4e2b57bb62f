// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace hapnet::scene {

/// A box along the axes of the world, metres.
struct Aabb {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};

    [[nodiscard]] glm::dvec3 size() const { return high - low; }
    [[nodiscard]] glm::dvec3 centre() const { return 0.5 * (low + high); }
};

// Without short cuts: compares are cheaper than branches that nothing predicts.

[[nodiscard]] inline bool overlap(const Aabb& a, const Aabb& b)
{
    return static_cast<int>(a.low.x <= b.high.x) & static_cast<int>(b.low.x <= a.high.x) &
           static_cast<int>(a.low.y <= b.high.y) & static_cast<int>(b.low.y <= a.high.y) &
           static_cast<int>(a.low.z <= b.high.z) & static_cast<int>(b.low.z <= a.high.z);
}

[[nodiscard]] inline bool contains(const Aabb& outer, const Aabb& inner)
{
    return static_cast<int>(outer.low.x <= inner.low.x) &
           static_cast<int>(inner.high.x <= outer.high.x) &
           static_cast<int>(outer.low.y <= inner.low.y) &
           static_cast<int>(inner.high.y <= outer.high.y) &
           static_cast<int>(outer.low.z <= inner.low.z) &
           static_cast<int>(inner.high.z <= outer.high.z);
}

[[nodiscard]] inline Aabb hull(const glm::dvec3& a, const glm::dvec3& b)
{
    return {glm::min(a, b), glm::max(a, b)};
}

[[nodiscard]] inline Aabb grown(const Aabb& box, const glm::dvec3& by)
{
    return {box.low - by, box.high + by};
}

} // namespace hapnet::scene

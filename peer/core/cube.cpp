// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/cube.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/math.hpp"

#include <cmath>
#include <glm/common.hpp>

namespace hapnet::peer {

Cube::Cube(const Scene& scene, base::Duration tick)
    : static_cube_{scene.static_cube},
      rest_height_{scene.cube.centre.y()},
      mass_{scene.cube_mass_kg},
      gravity_{scene.gravity_m_per_s2},
      tick_{base::to_seconds(tick)},
      kept_on_drag_{base::exp(-scene.drag_ns_per_m * tick_ / scene.cube_mass_kg)},
      push_on_drag_{scene.drag_ns_per_m > 0.0 ? (1.0 - kept_on_drag_) / scene.drag_ns_per_m
                                              : tick_ / scene.cube_mass_kg},
      box_{scene.cube}
{
    base::ensure(tick > base::Duration{0} && mass_ > 0.0);
}

void Cube::step(base::Force force)
{
    base::ensure(base::is_finite(force));
    const Box before = box_;
    const bool supported = box_.centre.y() <= rest_height_;
    const double kept = supported ? kept_on_drag_ : 1.0;
    const double gained = supported ? push_on_drag_ : tick_ / mass_;
    glm::dvec3 v = velocity_.value;
    v.x = kept * v.x + gained * force.x();
    v.z = kept * v.z + gained * force.z();
    v.y += tick_ * (force.y() / mass_ - gravity_);
    velocity_ = {v};
    box_.centre = {box_.centre.value + tick_ * v};
    stop_at_platform();
    stop_at_static_cube(before);
}

void Cube::place(base::Position position, base::Velocity velocity)
{
    base::ensure(base::is_finite(position) && base::is_finite(velocity));
    box_.centre = position;
    velocity_ = velocity;
}

void Cube::stop_at_platform()
{
    if (box_.centre.value.y > rest_height_) return;
    box_.centre.value.y = rest_height_;
    if (velocity_.value.y < 0.0) velocity_.value.y = 0.0;
}

void Cube::stop_at_static_cube(const Box& before)
{
    // Axis-parallel boxes meet face to face: on the axis along which they were most apart.
    const glm::dvec3 reach = box_.half + static_cube_.half;
    const glm::dvec3 apart = (box_.centre - static_cube_.centre).value;
    for (const int axis : {0, 1, 2}) {
        if (std::abs(apart[axis]) >= reach[axis]) return;
    }
    const glm::dvec3 apart_before = (before.centre - static_cube_.centre).value;
    const glm::dvec3 gap = glm::abs(apart_before) - reach; // < 0: placed into it, e.g. by rounding
    int axis = 0;
    for (const int other : {1, 2}) {
        if (gap[other] > gap[axis]) axis = other;
    }
    const double side = apart_before[axis] < 0.0 ? -1.0 : 1.0;
    box_.centre.value[axis] = static_cube_.centre.value[axis] + side * reach[axis];
    velocity_.value[axis] = 0.0;
}

} // namespace hapnet::peer

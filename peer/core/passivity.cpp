// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/passivity.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::peer {

VirtualWall hardest_wall(const scene::Description& scene)
{
    VirtualWall wall{scene.hands.stiffness_n_per_m, scene.hands.damping_ns_per_m};
    const auto meet = [&wall](double stiffness_n_per_m, double damping_ns_per_m) {
        wall.stiffness_n_per_m = std::max(wall.stiffness_n_per_m, stiffness_n_per_m);
        wall.damping_ns_per_m = std::max(wall.damping_ns_per_m, damping_ns_per_m);
    };
    for (const scene::BodyDescription& body : scene.bodies) {
        const scene::HandDescription on_it = scene::hand_on(scene.hands, {}, body.feel);
        meet(on_it.stiffness_n_per_m, on_it.damping_ns_per_m);
    }
    for (const scene::FieldDescription& field : scene.fields)
        if (field.on_hands) meet(field.stiffness_n_per_m, field.damping_ns_per_m);
    return wall;
}

double damping_for_passivity(const VirtualWall& wall, double tick_s)
{
    base::ensure(tick_s > 0.0);
    return wall.stiffness_n_per_m * tick_s / 2.0 + std::abs(wall.damping_ns_per_m);
}

double share_within(double stiffness_max_n_per_m, const VirtualWall& wall)
{
    base::ensure(stiffness_max_n_per_m >= 0.0);
    const bool is_stable =
        stiffness_max_n_per_m == 0.0 || wall.stiffness_n_per_m <= stiffness_max_n_per_m;
    return is_stable ? 1.0 : stiffness_max_n_per_m / wall.stiffness_n_per_m;
}

double passive_share(const VirtualWall& wall, double tick_s, double port_damping_ns_per_m)
{
    base::ensure(port_damping_ns_per_m >= 0.0);
    const double needed = damping_for_passivity(wall, tick_s);
    return needed <= port_damping_ns_per_m ? 1.0 : port_damping_ns_per_m / needed;
}

} // namespace hapnet::peer

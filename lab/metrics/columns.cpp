// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/metrics/columns.hpp"

namespace hapnet::lab::metrics {

namespace {

double dot_of(base::Force force, base::Displacement way)
{
    return force.x() * way.x() + force.y() * way.y() + force.z() * way.z();
}

} // namespace

Columns columns_of(std::span<const virtual_time::Sample> side)
{
    Columns columns;
    const std::size_t count = side.size();
    for (auto* column : {&columns.body_x, &columns.body_y, &columns.hip_x, &columns.hand_force,
                         &columns.push, &columns.work}) {
        column->resize(count);
    }
    columns.touching.resize(count);
    columns.follows.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const virtual_time::Sample& sample = side[i];
        const bool own = sample.touching || sample.holding;
        columns.body_x[i] = sample.body.x();
        columns.body_y[i] = sample.body.y();
        columns.hip_x[i] = sample.hip.x();
        columns.hand_force[i] = sample.on_hand.x();
        columns.push[i] = norm(sample.on_body);
        columns.touching[i] = own ? 1 : 0;
        columns.follows[i] = !own && sample.remote_touching ? 1 : 0;
        // The device holds a tick's force until the next tick, so this sum is exact and not an
        // approximate integration.
        const virtual_time::Sample& next = side[i + 1 < count ? i + 1 : i];
        columns.work[i] = -dot_of(sample.on_hand, next.hip - sample.hip);
    }
    return columns;
}

} // namespace hapnet::lab::metrics

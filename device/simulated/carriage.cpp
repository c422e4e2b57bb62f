// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/simulated/carriage.hpp"

#include "device/simulated/minimum_jerk.hpp"
#include "proto/base/ensure.hpp"

namespace hapnet::device {

Intention carried(const Carriage& carriage, double t)
{
    base::ensure(!carriage.way.empty());
    Waypoint here = carriage.way.front();
    for (const Waypoint& next : carriage.way.subspan(1)) {
        const double share = minimum_jerk((t - here.at_s) / (next.at_s - here.at_s));
        const double x_m = here.x_m + share * (next.x_m - here.x_m);
        const double y_m = here.y_m + share * (next.y_m - here.y_m);
        here = {next.at_s, x_m, y_m};
        if (t < next.at_s) break;
    }
    return {.target = {{here.x_m, here.y_m, 0.0}},
            .gripping = t >= carriage.grips_s && t < carriage.lets_go_s};
}

} // namespace hapnet::device

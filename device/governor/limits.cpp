// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/limits.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>

namespace hapnet::device {

namespace {

constexpr double continuous_share_unsaid = 0.25;

bool is_positive(double value) { return value > 0.0; } // false for NaN
bool is_positive(base::Duration value) { return value > base::Duration{0}; }

bool has_workspace(const GovernorLimits& limits)
{
    for (const int axis : {0, 1, 2}) {
        if (!(limits.workspace_min.value[axis] < limits.workspace_max.value[axis])) return false;
    }
    return true;
}

} // namespace

base::Result<void> validate(const GovernorLimits& limits)
{
    const bool has_lengths = is_positive(limits.fade_out) && is_positive(limits.ramp_in) &&
                             is_positive(limits.tick) && is_positive(limits.heat_time);
    if (!has_lengths) {
        return base::fail("fade_out, ramp_in, tick and heat_time must be longer than 0");
    }
    const bool has_sizes = is_positive(limits.slew_max_n_per_s) &&
                           is_positive(limits.slew_ramping_n_per_s) &&
                           is_positive(limits.speed_max_m_per_s);
    if (!has_sizes) return base::fail("slew_max, slew_ramping and speed_max must be above 0");
    if (!(limits.force_max_n >= 0.0) || !(limits.force_continuous_n >= 0.0)) {
        return base::fail("force_max and force_continuous must not be negative");
    }
    if (limits.force_continuous_n == 0.0 && limits.force_max_n > 0.0) {
        return base::fail("force_continuous is 0, but force_max is not: motors that can hold no "
                          "force continuously can give none");
    }
    if (limits.stall_max <= limits.tick) {
        return base::fail("stall_max must be longer than tick, or every tick is a stall");
    }
    if (limits.fault_after < limits.stall_max) {
        return base::fail("fault_after must not be shorter than stall_max");
    }
    if (!has_workspace(limits)) {
        return base::fail("workspace_min must be below workspace_max on every axis");
    }
    if (!(limits.heat_start >= 0.0)) return base::fail("heat_start must not be negative");
    if (limits.energy && !(limits.energy->power_max_w > 0.0 && limits.energy->work_max_j > 0.0)) {
        return base::fail("power_max and work_max must be above 0");
    }
    return {};
}

GovernorLimits limits_for(const Capabilities& capabilities, const GovernorLimits& limits)
{
    base::ensure(capabilities.force_max_n >= 0.0 && limits.force_max_n >= 0.0);
    GovernorLimits narrow = limits;
    narrow.force_max_n = std::min(limits.force_max_n, capabilities.force_max_n);
    const double continuous = capabilities.force_continuous_n > 0.0
                                  ? capabilities.force_continuous_n
                                  : continuous_share_unsaid * capabilities.force_max_n;
    narrow.force_continuous_n = std::min(limits.force_continuous_n, continuous);
    narrow.speed_max_m_per_s = std::min(limits.speed_max_m_per_s, capabilities.speed_max_m_per_s);
    narrow.axes_out = std::min(limits.axes_out, capabilities.axes_out);
    for (int axis = 0; axis < capabilities.axes_in; ++axis) {
        double& low = narrow.workspace_min.value[axis];
        double& high = narrow.workspace_max.value[axis];
        low = std::max(low, capabilities.workspace_min.value[axis]);
        high = std::min(high, capabilities.workspace_max.value[axis]);
    }
    narrow.joints = capabilities.joints;
    return narrow;
}

} // namespace hapnet::device

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/limits.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>

namespace hapnet::device {

namespace {

constexpr double continuous_share_unsaid = 0.25;

} // namespace

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

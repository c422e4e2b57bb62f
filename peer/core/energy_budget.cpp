// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/energy_budget.hpp"

#include <algorithm>
#include <variant>

namespace hapnet::peer {

namespace {

constexpr double omni_force_n = 3.3;
constexpr double least_share = 0.05; // of a device without force: its limits are never reached

// At an Omni, in watts, by the guard's own estimate; the tasks need 0.45 and 1.34.
constexpr double power_w = 0.46;
constexpr double predicting_power_w = 1.4;
// In 5 s; they need 0.081 with nominal hands. The last tick of an attack may go 0.2 mJ beyond.
constexpr double work_j = 0.149;

} // namespace

device::EnergyLimits energy_budget(const device::Capabilities& capabilities,
                                   const Algorithm& algorithm)
{
    const bool predicts = !std::holds_alternative<BaseAlgorithm>(algorithm);
    const double share = std::clamp(capabilities.force_max_n / omni_force_n, least_share, 1.0);
    return {.power_max_w = share * (predicts ? predicting_power_w : power_w),
            .work_max_j = share * work_j};
}

} // namespace hapnet::peer

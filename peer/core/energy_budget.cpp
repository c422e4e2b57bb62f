// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/energy_budget.hpp"

#include <algorithm>
#include <variant>

namespace hapnet::peer {

namespace {

constexpr double omni_force_n = 3.3;
// The least share. A device without force gets it, and never reaches its limits.
constexpr double least_share = 0.05;

} // namespace

device::EnergyLimits energy_budget(const device::Capabilities& capabilities,
                                   const Algorithm& algorithm)
{
    const double share = std::clamp(capabilities.force_max_n / omni_force_n, least_share, 1.0);
    const device::EnergyLimits limits =
        std::visit([](const auto& one) { return one.energy_limits; }, algorithm);
    return {.power_max_w = share * limits.power_max_w, .work_max_j = share * limits.work_max_j};
}

} // namespace hapnet::peer

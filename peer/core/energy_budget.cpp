// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/energy_budget.hpp"

#include <algorithm>
#include <array>

namespace hapnet::peer {

namespace {

constexpr double omni_force_n = 3.3;
constexpr double least_share = 0.05; // of a device without force: its limits are never reached

// In 5 s. The last tick of an attack may go 0.2 mJ beyond.
constexpr double work_j = 0.149;

/// At an Omni, in the order of the variant. Above what nominal hands need, by the guard's own
/// estimate of the power; docs/design/governor.md has the figures.
constexpr std::array<device::EnergyLimits, std::variant_size_v<Algorithm>> at_an_omni{{
    {.power_max_w = 0.46, .work_max_j = work_j}, // base
    {.power_max_w = 1.1, .work_max_j = work_j},  // dead-reckoning
    {.power_max_w = 1.1, .work_max_j = work_j},  // sep
    {.power_max_w = 0.4, .work_max_j = work_j},  // remote-proxy
    {.power_max_w = 0.5, .work_max_j = 0.2},     // base-tdpa
    {.power_max_w = 1.2, .work_max_j = work_j},  // wave
    {.power_max_w = 0.7, .work_max_j = work_j},  // couple
    {.power_max_w = 0.25, .work_max_j = work_j}, // lag
    {.power_max_w = 0.25, .work_max_j = work_j}, // rollback
    {.power_max_w = 0.46, .work_max_j = work_j}, // shared-object: as base, whatever it is
}};

} // namespace

device::EnergyLimits energy_budget(const device::Capabilities& capabilities,
                                   const Algorithm& algorithm)
{
    const double share = std::clamp(capabilities.force_max_n / omni_force_n, least_share, 1.0);
    const device::EnergyLimits& limits = at_an_omni.at(algorithm.index());
    return {.power_max_w = share * limits.power_max_w, .work_max_j = share * limits.work_max_j};
}

} // namespace hapnet::peer

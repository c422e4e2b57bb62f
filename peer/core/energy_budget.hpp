// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/governor/energy.hpp"
#include "peer/core/sync/algorithm.hpp"

namespace hapnet::peer {

/// Returns the energy that a session may bring into a hand at this device. It is above what the
/// tasks need with this algorithm at delays up to 160 ms, and in proportion to the device's force,
/// up to that of an Omni. The needs of a shared object are not known: it gets the budget of `base`.
/// docs/design/governor.md has the figures.
[[nodiscard]] device::EnergyLimits energy_budget(const device::Capabilities& capabilities,
                                                 const Algorithm& algorithm);

} // namespace hapnet::peer

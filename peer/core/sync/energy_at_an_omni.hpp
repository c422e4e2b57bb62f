// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor/energy.hpp"

namespace hapnet::peer {

/// Returns the energy that a session with an algorithm may bring into a hand at an Omni. It is
/// above what nominal hands need, by the guard's own estimate of the power. docs/design/governor.md
/// has the figures. An algorithm that names no other work has 0.149 J in 5 s, because the last tick
/// of an attack may exceed the limit by 0.2 mJ.
[[nodiscard]] constexpr device::EnergyLimits energy_at_an_omni(double power_max_w,
                                                               double work_max_j = 0.149)
{
    return {.power_max_w = power_max_w, .work_max_j = work_max_j};
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/control/statistics.hpp"

namespace hapnet::peer {

GovernorFigures governor_figures(const device::Rig& rig)
{
    const device::Governor& governor = rig.governor();
    return {.state = governor.state(),
            .fault = governor.fault(),
            .force_limit_n = governor.limits().force_max_n,
            .motor_heat = governor.heat(),
            .counters = governor.counters(),
            .device = rig.counters()};
}

} // namespace hapnet::peer

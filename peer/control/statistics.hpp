// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "peer/core/peer.hpp"

#include <nlohmann/json_fwd.hpp>

namespace hapnet::peer {

// The parts of a peer's statistics that it has in real and in virtual time.

[[nodiscard]] nlohmann::json messages_json(const Counters& counters);

/// What is counted and held between the loop and the motors.
struct GovernorFigures {
    device::GovernorState state = device::GovernorState::off;
    device::Latched fault{};
    double force_limit_n = 0.0;
    double motor_heat = 0.0;
    device::GovernorCounters counters{};
    device::RigCounters device{};
};
[[nodiscard]] GovernorFigures governor_figures(const device::Rig& rig);
[[nodiscard]] nlohmann::json governor_json(const GovernorFigures& figures);

} // namespace hapnet::peer

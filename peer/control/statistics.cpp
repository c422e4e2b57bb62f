// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/control/statistics.hpp"

#include <nlohmann/json.hpp>

namespace hapnet::peer {

nlohmann::json messages_json(const Counters& counters)
{
    return {{"states_sent", counters.sent},       {"states_received", counters.states},
            {"outdated", counters.outdated},      {"other_session", counters.other_session},
            {"hellos", counters.hellos},          {"byes", counters.byes},
            {"malformed", counters.malformed},    {"other_version", counters.other_version},
            {"implausible", counters.implausible}};
}

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

nlohmann::json governor_json(const GovernorFigures& figures)
{
    const device::GovernorCounters& c = figures.counters;
    return {{"state", device::name_of(figures.state)},
            {"fault", device::name_of(figures.fault.fault)},
            {"tripped_by", device::name_of(figures.fault.trip)},
            {"force_limit_n", figures.force_limit_n},
            {"motor_heat", figures.motor_heat},
            {"not_finite", c.not_finite},
            {"clamped", c.clamped},
            {"heat_limited", c.heat_limited},
            {"joint_limited", c.joint_limited},
            {"flattened", c.flattened},
            {"outside", c.outside},
            {"slewed", c.slewed},
            {"faded", c.faded},
            {"stalled", c.stalled},
            {"silent", c.silent},
            {"docked", c.docked},
            {"uncalibrated", c.uncalibrated},
            {"too_fast", c.too_fast},
            {"faults",
             {{"device", c.device_faults},
              {"silence", c.silence_faults},
              {"loop", c.loop_faults},
              {"speed", c.speed_trips},
              {"jump", c.jump_trips},
              {"nonsense", c.nonsense_trips},
              {"frozen", c.frozen_trips},
              {"runaway", c.runaway_trips}}},
            {"resets", c.resets},
            {"device",
             {{"reads", figures.device.reads},
              {"repeated", figures.device.repeated},
              {"repeated_most", figures.device.repeated_most}}}};
}

} // namespace hapnet::peer

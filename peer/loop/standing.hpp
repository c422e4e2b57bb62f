// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "peer/core/peer.hpp"
#include "proto/base/histogram.hpp"
#include "proto/net/real_time.hpp"
#include "proto/record/rows.hpp"

#include <optional>

namespace hapnet::peer {

/// How punctual the loop was.
struct LoopCounters {
    std::uint64_t ticks = 0;
    std::uint64_t missed = 0; // ticks skipped because the one before ended too late
    base::DurationHistogram late;
    std::uint64_t strangers = 0;     // datagrams from elsewhere than the remote
    std::uint64_t send_failures = 0; // the remote's host may be down: not an end
};

/// How a peer stands after one of its ticks: what the statistics are made of. 19 KiB.
struct Standing {
    base::TimePoint at;
    base::Duration elapsed{}; // since the first tick
    record::Phase phase = record::Phase::waiting;
    bool is_remote_heard = false; // of late
    base::Force force;            // that the device was told, at the hand
    LoopCounters loop;
    Counters messages;
    std::optional<Session> session;
    std::optional<ClockOffset::Estimate> clock;
    std::optional<wire::ByeReason> refusal;
    device::CalibrationStep calibration = device::CalibrationStep::done;
    device::GovernorState governor_state = device::GovernorState::off;
    device::Latched fault{};
    device::GovernorCounters governor;
    double force_limit_n = 0.0;
    double motor_heat = 0.0;
    device::RigCounters device;
    std::uint64_t watchdog_halts = 0;
    std::uint64_t overflowed = 0; // datagrams that the socket had no room for
    net::RealTime real_time;
};

} // namespace hapnet::peer

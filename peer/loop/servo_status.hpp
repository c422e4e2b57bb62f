// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"
#include "peer/core/peer.hpp"
#include "peer/line/status.hpp"
#include "peer/loop/force_gate.hpp"
#include "proto/base/histogram.hpp"
#include "proto/net/batch_sender.hpp"
#include "proto/net/real_time.hpp"
#include "proto/record/rows.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::peer::loop {

/// Counters of the loop's punctuality and of its socket.
struct LoopCounters {
    std::uint64_t ticks = 0;
    std::uint64_t missed = 0; // ticks skipped because the previous one ended too late
    base::DurationHistogram late;
    std::uint64_t send_failures = 0; // not fatal: the remote's host may be down
    net::SendOutcome last_send = net::SendOutcome::sent;
    std::uint64_t withheld = 0;   // ticks without force because of a person or a signal
    std::uint64_t unrecorded = 0; // datagrams of a flood that the record leaves out
    std::uint64_t too_long = 0;   // messages too long for the record's rows
};

/// The status of one of the others: its clock, the path to it and back, and the line.
struct OtherStatus {
    std::uint16_t id = 0;               // 0: not known yet
    std::optional<ClockEstimate> clock; // set even while it is in doubt
    bool is_clock_in_doubt = false;
    std::uint32_t clock_jumps = 0;
    PathsReport paths;
    std::uint32_t session = 0; // the number of the session with it; 0: none
    bool is_heard = false;     // its newest state is not stale
    bool is_gone = false;      // the peer has said goodbye
    line::Status line;
};

/// The status of a peer after one of its ticks, from which statistics are made. Its size is 20 KiB.
struct ServoStatus {
    base::TimePoint at;
    base::Duration elapsed{}; // since the first tick
    record::Phase phase = record::Phase::waiting;
    bool is_remote_heard = false; // at least one other peer's newest state is not stale
    base::Force force;            // force at the hand that was sent to the device
    LoopCounters loop;
    Counters messages;
    std::optional<Session> session;
    bool is_left = false; // this peer acts as A
    std::array<OtherStatus, peers_max - 1> others{};
    std::size_t others_count = 0;
    [[nodiscard]] bool is_pair() const { return others_count <= 1; }
    std::optional<wire::ByeReason> refusal;
    device::CalibrationStep calibration = device::CalibrationStep::done;
    device::GovernorState governor_state = device::GovernorState::off;
    Withheld withheld = Withheld::no;
    device::Latched fault{};
    device::GovernorCounters governor;
    double force_limit_n = 0.0;
    double motor_heat = 0.0;
    std::optional<device::EnergyLimits> energy_limits;
    device::EnergyFigures energy;
    device::RigCounters device;
    std::uint64_t watchdog_halts = 0;
    std::uint64_t overflowed = 0; // datagrams dropped because the socket's buffer was full
    net::RealTime real_time;
};

} // namespace hapnet::peer::loop

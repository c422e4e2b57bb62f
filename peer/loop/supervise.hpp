// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/loop/servo.hpp"
#include "peer/monitor/control_session.hpp"
#include "peer/monitor/monitor.hpp"
#include "proto/net/stop_signal.hpp"

#include <string>

namespace hapnet::peer::loop {

/// A servo and the parts that run beside it.
struct Supervised {
    Servo& servo;
    monitor::Monitor& monitor;
    net::StopSignal& stop;
    monitor::ControlSession* control_session = nullptr; // null: there is no control socket
};

/// Runs the servo on a thread of its own and watches it from this one until it has ended; SIGINT,
/// SIGTERM and SIGHUP end it, and clients of the control socket may. Prints `ready` when its first
/// tick has run. What the servo throws comes out of here, when the device has been told zero
/// force.
void supervise(const Supervised& supervised, const std::string& ready);

} // namespace hapnet::peer::loop

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/servo.hpp"
#include "peer/watcher.hpp"
#include "proto/net/stop_signal.hpp"

#include <string>

namespace hapnet::peer {

/// Runs the servo on a thread of its own and watches it from this one until it has ended; SIGINT,
/// SIGTERM and SIGHUP end it. Prints `ready` when its first tick has run. What the servo throws
/// comes out of here, when the device has been told zero force.
void supervise(Servo& servo, Watcher& watcher, net::StopSignal& stop, const std::string& ready);

} // namespace hapnet::peer

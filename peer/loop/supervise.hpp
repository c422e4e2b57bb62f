// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/loop/servo.hpp"
#include "peer/monitor/control_session.hpp"
#include "peer/monitor/monitor.hpp"
#include "peer/monitor/plot_stream.hpp"
#include "proto/net/service_manager.hpp"
#include "proto/net/stop_signal.hpp"

#include <string>

namespace hapnet::peer::loop {

/// A servo and the parts that run beside it.
struct Supervised {
    Servo& servo;
    monitor::Monitor& monitor;
    const net::StopSignal& stop;
    ForceGate& gate;
    net::TextQueue& out;                                // stdout
    net::TextQueue& screen;                             // stderr
    monitor::ControlSession* control_session = nullptr; // null: there is no control socket
    monitor::PlotStream* plot = nullptr;                // null: there is no --plotjuggler
    net::ServiceManager* manager = nullptr;             // null: no service manager is told
};

/// The time after a stop was asked for. Text and record that are not written by then are given up.
inline constexpr base::Duration give_up_after{std::chrono::milliseconds{300}};
/// Without a stop, text is given up when its reader has taken none of it for this time.
inline constexpr base::Duration text_patience{std::chrono::seconds{2}};

/// Runs the servo on a thread of its own and watches it from this one until it has ended; SIGINT,
/// SIGTERM, SIGHUP and clients of the control socket can end it. Enter at the terminal is an
/// emergency stop. Prints `ready` when its first tick has run, and tells the manager so; signs of
/// life go to the manager while the loop moves. Does not wait for slow readers of its output. At
/// the end it waits for the record, but after a stop no longer than give_up_after. Throws what the
/// servo throws, after the device has been told zero force.
void supervise(const Supervised& supervised, const std::string& ready);

/// Waits until the text is written, or given up as above.
void wait_for_readers(const net::TextQueue& text, const net::StopSignal& stop);

} // namespace hapnet::peer::loop

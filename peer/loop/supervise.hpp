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
    net::ServiceManager* manager = nullptr;             // null: nobody is told how it goes
};

/// After a stop was asked for, what is not written by then is given up.
inline constexpr base::Duration give_up_after{std::chrono::milliseconds{300}};
/// Without one: what nobody has taken any of for so long.
inline constexpr base::Duration text_patience{std::chrono::seconds{2}};

/// Runs the servo on a thread of its own and watches it from this one until it has ended; SIGINT,
/// SIGTERM and SIGHUP end it, and clients of the control socket may. Enter at the terminal is an
/// emergency stop. Prints `ready` when its first tick has run, and tells the manager so; signs of
/// life go to that one while the loop moves. Waits for nobody who does not take
/// what is written; at the end, and until a stop, for the record. What the servo throws comes out
/// of here, when the device has been told zero force.
void supervise(const Supervised& supervised, const std::string& ready);

/// Waits until what was said is written, or given up as above.
void wait_for_readers(const net::TextQueue& text, const net::StopSignal& stop);

} // namespace hapnet::peer::loop

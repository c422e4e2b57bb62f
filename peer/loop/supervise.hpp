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
    monitor::ControlSession* control_session = nullptr; // nullptr: no control socket
    monitor::PlotStream* plot = nullptr;                // nullptr: no --plotjuggler
    net::ServiceManager* manager = nullptr;             // nullptr: no service manager
};

/// The time after a stop was requested at which text and record that are not written yet are given
/// up.
inline constexpr base::Duration give_up_after{std::chrono::milliseconds{300}};
/// The time without progress after which, without a stop, text is given up because its reader takes
/// nothing.
inline constexpr base::Duration text_patience{std::chrono::seconds{2}};

/// Runs the servo on its own thread and watches it from this one until it has ended. SIGINT,
/// SIGTERM, SIGHUP and clients of the control socket can end it. The Enter key at the terminal is
/// an emergency stop. Prints `ready` after the servo's first tick, and informs the manager, which
/// gets keep-alive messages as long as the loop makes progress. Does not wait for slow readers of
/// its output. At the end it waits for the record, but after a stop no longer than give_up_after.
/// Throws the exceptions of the servo, after zero force has been sent to the device.
void supervise(const Supervised& supervised, const std::string& ready);

/// Waits until the text is written, or is given up by the rules above.
void wait_for_readers(const net::TextQueue& text, const net::StopSignal& stop);

} // namespace hapnet::peer::loop

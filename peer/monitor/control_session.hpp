// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/cli/options.hpp"
#include "peer/loop/servo.hpp"
#include "peer/monitor/device_news.hpp"
#include "peer/monitor/monitor.hpp"
#include "proto/control/server.hpp"

#include <optional>
#include <string>

namespace hapnet::peer::monitor {

/// Answers the clients of the control socket. The loop does the same work with and without clients:
/// it fills in its status every 50 ms. The monitoring thread does everything else here.
class ControlSession {
public:
    /// All parts must outlive it.
    struct Parts {
        control::Server& server;
        loop::Servo& servo;
        const net::StopSignal& stop;
        loop::ForceGate& gate;
        const Options& options;
        Monitor& monitor;
        std::string device; // description of the device
        Recovery recovery{};
    };

    explicit ControlSession(Parts parts);
    ~ControlSession() = default;
    ControlSession(const ControlSession&) = delete;
    ControlSession& operator=(const ControlSession&) = delete;

    /// Serves the clients. Call it at the interval `every`. Clients are not served in between, so
    /// none can keep the thread busy: at most 800 requests a second are answered.
    void serve(base::TimePoint now);
    static constexpr base::Duration every{std::chrono::milliseconds{10}};
    /// The limits, which are sufficient for every request.
    static constexpr control::Server::Limits limits{.line_bytes = std::size_t{16} << 10,
                                                    .answers = 8};

private:
    [[nodiscard]] control::Subject subject();

    Parts parts_;
    control::Subject subject_;
    std::optional<loop::ServoStatus> status_; // newest status of the servo
    std::optional<base::TimePoint> next_request_;
};

} // namespace hapnet::peer::monitor

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/stop_signal.hpp"
#include "proto/net/unix_socket.hpp"
#include "proto/net/wait_set.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::ctl {

/// A client's connection to the control socket of a program. It sends and receives lines.
class Connection {
public:
    enum class State : std::uint8_t {
        good,
        closed,  // the program has ended or closed the connection
        late,    // no answer before the deadline
        stopped, // a stop signal arrived
    };

    /// Throws std::system_error if no program answers at the path.
    Connection(const std::string& path, net::StopSignal& stop);

    /// Sends a line, without its newline.
    [[nodiscard]] State send(std::string_view line, base::TimePoint deadline);

    /// Waits for the next line, which line() then returns.
    [[nodiscard]] State receive(std::optional<base::TimePoint> deadline);
    [[nodiscard]] const std::string& line() const { return line_; }

private:
    State wait(net::WaitSet::Interest interest, std::optional<base::TimePoint> deadline);

    net::StopSignal& stop_;
    net::UnixStream stream_;
    net::WaitSet wait_set_;
    std::string input_;
    std::string line_;
};

} // namespace hapnet::ctl

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/control/core/conversation.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::peer::monitor {

/// Sends frames to a plotter as JSON over UDP, one object per datagram, in the form that the UDP
/// server of PlotJuggler reads: {"timestamp":S,"peer_1":{...}}. Nothing is received, and no
/// listener is needed.
class PlotStream {
public:
    /// Throws std::system_error if no socket can be created.
    PlotStream(const net::Endpoint& to, std::uint16_t peer_id, control::FrameSource frames);

    /// Sends a frame if it is due. It covers the rows drained since the previous one.
    void serve(base::TimePoint now);

    static constexpr base::Duration every{std::chrono::milliseconds{20}};

private:
    net::Endpoint to_;
    std::uint16_t peer_id_;
    control::FrameSource frames_;
    net::UdpSocket socket_;
    std::optional<base::TimePoint> next_;
    std::string text_;
};

} // namespace hapnet::peer::monitor

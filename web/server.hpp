// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "web/assets.hpp"
#include "web/core/gate.hpp"
#include "web/hub.hpp"
#include "web/request.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <list>
#include <memory>
#include <string>
#include <vector>

namespace hapnet::web {

/// The HTTP server: moves bytes between browsers, the gate and the hub. All limits on connections
/// are here.
class Server {
public:
    struct Limits {
        RequestLimits request{};
        std::size_t connections = 32; // limit; pages that have shown the token do not count
        int posts_per_second = 40;
    };

    /// The parts that the server uses. They must outlive it.
    struct Parts {
        boost::asio::io_context& io;
        Hub& hub;
        const Gate& gate;
        const Page& page;
    };

    explicit Server(const Parts& parts);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// Accepts the connections to a listening socket.
    void accept_from(boost::asio::ip::tcp::acceptor acceptor);

    /// The state that the server shares with its connections, which may outlive it for a moment.
    struct State;

private:
    std::shared_ptr<State> state_;
};

} // namespace hapnet::web

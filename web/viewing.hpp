// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "web/core/gate.hpp"
#include "web/core/visitors.hpp"
#include "web/hub.hpp"
#include "web/request.hpp"

#include <boost/asio/ip/tcp.hpp>

namespace hapnet::web {

/// The parts that a live view uses. All of them except the visitors outlive every live view.
struct LiveParts {
    Hub& hub;
    const Gate& gate;
    Visitors& visitors;
};

/// Serves live frames to a page over a WebSocket until it disconnects. The page sends the token
/// first, then acknowledgements of frames. A page counts as a visitor until it has sent the right
/// token. A slow page gets fewer frames; a page that reads nothing is disconnected.
void view_live(boost::asio::ip::tcp::socket socket, const Request& request, const LiveParts& parts);

} // namespace hapnet::web

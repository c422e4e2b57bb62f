// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "web/core/gate.hpp"
#include "web/core/visitors.hpp"
#include "web/hub.hpp"
#include "web/request.hpp"

#include <boost/asio/ip/tcp.hpp>

namespace hapnet::web {

/// Outlive all that is live, but for the visitors.
struct LiveParts {
    Hub& hub;
    const Gate& gate;
    Visitors& visitors;
};

/// Lets a page look at what is live, over a WebSocket, until it goes: the token comes first, then
/// acknowledgements of frames. Until the token has come, and for ever if it is wrong, the page
/// counts as a visitor. A page that does not keep up gets fewer frames; one that reads nothing is
/// left.
void view_live(boost::asio::ip::tcp::socket socket, const Request& request, const LiveParts& parts);

} // namespace hapnet::web

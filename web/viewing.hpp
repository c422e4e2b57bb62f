// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "web/core/gate.hpp"
#include "web/hub.hpp"
#include "web/request.hpp"

#include <boost/asio/ip/tcp.hpp>

namespace hapnet::web {

/// Lets a page look at what is live, over a WebSocket, until it goes: the token comes first, then
/// acknowledgements of frames. A page that does not keep up gets fewer frames; one that reads
/// nothing is left. `hub` and `gate` outlive it.
void view_live(boost::asio::ip::tcp::socket socket, const Request& request, Hub& hub,
               const Gate& gate);

} // namespace hapnet::web

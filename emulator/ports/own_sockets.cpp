// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/own_sockets.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::emulator::ports {

void OwnSockets::add(const net::Endpoint& local)
{
    Socket socket{local, {}};
    socket.host.add_host(local);
    const std::scoped_lock guard{lock_};
    sockets_.push_back(std::move(socket));
}

void OwnSockets::remove(const net::Endpoint& local)
{
    const std::scoped_lock guard{lock_};
    const auto found = std::ranges::find(sockets_, local, &Socket::local);
    if (found != sockets_.end()) sockets_.erase(found);
}

bool OwnSockets::contains(const net::Endpoint& from) const
{
    const std::scoped_lock guard{lock_};
    const auto port = from.port();
    return std::ranges::any_of(sockets_, [&](const Socket& socket) {
        if (socket.local.port() != port) return false;
        return (socket.local.is_any() ? this_machine_ : socket.host).contains(from);
    });
}

} // namespace hapnet::emulator::ports

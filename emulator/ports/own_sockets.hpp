// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/address_set.hpp"
#include "proto/net/endpoint.hpp"

#include <mutex>
#include <vector>

namespace hapnet::emulator::ports {

/// The emulator's own sockets. A datagram that seems to come from one of them is forged, or is one
/// of the emulator's own that came back. If it were accepted, it would circulate for ever. Call it
/// from any thread. It is asked only about unknown senders.
class OwnSockets {
public:
    void add(const net::Endpoint& local);
    void remove(const net::Endpoint& local);
    [[nodiscard]] bool contains(const net::Endpoint& from) const;

private:
    struct Socket {
        net::Endpoint local;
        net::AddressSet host; // addresses of `local`, unless it is any address
    };
    net::AddressSet this_machine_ = net::addresses_of_this_machine();
    mutable std::mutex lock_;
    std::vector<Socket> sockets_;
};

} // namespace hapnet::emulator::ports

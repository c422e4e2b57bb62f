// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/correspondent.hpp"
#include "emulator/core/link.hpp"
#include "emulator/options.hpp"
#include "emulator/places.hpp"
#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::emulator {

/// The two sockets and the two directions between them. Moves datagrams; every decision is taken
/// in Link and Correspondent.
class Relay {
public:
    /// Binds both sockets. Throws std::system_error when it cannot.
    Relay(const Places& places, const Options& options);

    /// Takes what has arrived, at most one batch a side, so that a flood cannot hold up what is
    /// due, and sends on at once what is not delayed. Returns how many senders were adopted by
    /// that.
    int receive();

    /// Sends what is due at `now`, the two sides in turn; so much at most that what arrives does
    /// not have to wait long. What is left is still due.
    void release(base::TimePoint now);

    /// When the next datagram is due to leave; nullopt when none is in flight.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const;

    /// Other conditions for what is taken from now on.
    void change(const Path& path, base::TimePoint now);

    /// When the sockets were bound: time 0 of the run.
    [[nodiscard]] base::TimePoint start() const { return start_; }

    /// One side of the relay, and the direction that begins there.
    struct Side {
        Side(const net::Endpoint& listen, const std::optional<net::Endpoint>& peer, Link direction);

        net::UdpSocket socket;
        Correspondent<net::Endpoint> correspondent;
        Link link;
        std::uint64_t strangers = 0; // datagrams from any other address
    };
    [[nodiscard]] const Side& a() const { return a_; }
    [[nodiscard]] const Side& b() const { return b_; }

private:
    base::TimePoint start_;
    Side a_;
    Side b_;
};

} // namespace hapnet::emulator

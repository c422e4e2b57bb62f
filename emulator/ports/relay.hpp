// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/capture/pcapng.hpp"
#include "emulator/core/emulated_path.hpp"
#include "emulator/core/endpoint_filter.hpp"
#include "emulator/core/rate_limit.hpp"
#include "emulator/endpoints.hpp"
#include "emulator/ports/batch.hpp"
#include "emulator/recorder.hpp"
#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::emulator::ports {

/// The two sockets and the path between them. Moves datagrams; EmulatedPath and EndpointFilter take
/// every decision.
class Relay {
public:
    /// Binds both sockets. Throws std::system_error when it cannot. The path and the recorder
    /// outlive it.
    Relay(const Endpoints& endpoints, EmulatedPath& path, Recorder& recorder);

    /// Takes what has arrived, at most one batch a side, so that a flood cannot hold up what is
    /// due, and sends on at once what is not delayed. Conditions that change in the meantime hold
    /// from the first datagram that arrived after their time. Returns how many senders were
    /// adopted by that.
    int receive();

    /// Sends what is due at `now`, the two sides in turn; so much at most that what arrives does
    /// not have to wait long. What is left is still due.
    void release(base::TimePoint now);

    /// Somebody whose datagram was dropped, and why.
    struct Stranger {
        net::Endpoint who;
        std::optional<net::Endpoint> owner; // of this side
        base::TimePoint owner_heard{};
        bool adopts = false; // this side takes another one when its owner is silent
        bool is_own = false; // forged
        base::TimePoint at{};
    };

    /// One side of the relay, and the direction that begins there.
    struct Side {
        Side(CaptureSide which, const net::Endpoint& listen,
             const std::optional<net::Endpoint>& peer, const Link& from_here);

        CaptureSide side;
        Direction direction; // of the datagrams that come from here
        net::UdpSocket socket;
        net::Endpoint local;
        EndpointFilter<net::Endpoint> filter;
        const Link& link;            // of that direction
        std::uint64_t strangers = 0; // datagrams from any other address, our own among them
        RateLimit notice{};
        std::optional<Stranger> stranger{}; // one that nobody has been told of

        [[nodiscard]] Exit exit() { return {side, socket, local, filter.address()}; }

        void on_stranger(const net::Endpoint& who, base::TimePoint at, bool is_own);
    };

    /// A stranger of either side that somebody should be told of, once for each; nullopt: there is
    /// none. After one no other of its side is named for a while.
    [[nodiscard]] std::optional<std::string> next_notice();

    [[nodiscard]] const Side& a() const { return a_; }
    [[nodiscard]] const Side& b() const { return b_; }

private:
    int pass(Side& from, Side& to);

    EmulatedPath& path_;
    Recorder& recorder_;
    Side a_;
    Side b_;
};

} // namespace hapnet::emulator::ports

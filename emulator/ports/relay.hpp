// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/capture/pcapng.hpp"
#include "emulator/core/conditions.hpp"
#include "emulator/core/correspondent.hpp"
#include "emulator/core/director.hpp"
#include "emulator/core/fates/fates.hpp"
#include "emulator/core/link.hpp"
#include "emulator/places.hpp"
#include "emulator/recorder.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"

#include <cstdint>
#include <memory>
#include <optional>

namespace hapnet::emulator {

/// The two sockets and the two directions between them. Moves datagrams; every decision is taken
/// in Link and Correspondent.
class Relay {
public:
    struct Setup {
        const Path& path; // the conditions at the beginning
        base::Seed seed;
        base::TimePoint start;               // time 0 of all that depends on time
        std::shared_ptr<const Fates> replay; // null: fates are drawn
    };

    /// Binds both sockets. Throws std::system_error when it cannot. The recorder outlives it.
    Relay(const Places& places, const Setup& setup, Recorder& recorder);

    /// Takes what has arrived, at most one batch a side, so that a flood cannot hold up what is
    /// due, and sends on at once what is not delayed. Conditions that change in the meantime hold
    /// from the first datagram that arrived after their time. Returns how many senders were
    /// adopted by that.
    int receive(Director& director);

    /// Sends what is due at `now`, the two sides in turn; so much at most that what arrives does
    /// not have to wait long. What is left is still due.
    void release(base::TimePoint now);

    /// Other conditions for what arrives from now on.
    void change(const Path& path, base::TimePoint now);

    /// When the next datagram is due to leave; nullopt when none is in flight.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const;

    /// One side of the relay, and the direction that begins there.
    struct Side {
        Side(CaptureSide which, const net::Endpoint& listen,
             const std::optional<net::Endpoint>& peer, Link from_here);

        CaptureSide side;
        net::UdpSocket socket;
        net::Endpoint local;
        Correspondent<net::Endpoint> correspondent;
        Link link;
        std::uint64_t strangers = 0; // datagrams from any other address, our own among them
    };
    [[nodiscard]] const Side& a() const { return a_; }
    [[nodiscard]] const Side& b() const { return b_; }

private:
    int pass(Side& from, Side& to, Director& director);
    bool send_due(Side& from, Side& to, base::TimePoint now);

    Recorder& recorder_;
    Side a_;
    Side b_;
};

} // namespace hapnet::emulator

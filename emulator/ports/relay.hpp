// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/capture/pcapng.hpp"
#include "emulator/core/endpoint_filter.hpp"
#include "emulator/core/paths.hpp"
#include "emulator/core/rate_limit.hpp"
#include "emulator/endpoints.hpp"
#include "emulator/ports/batch.hpp"
#include "emulator/ports/own_sockets.hpp"
#include "emulator/recorder.hpp"
#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::emulator::ports {

/// Two sockets and the path between them. Relay moves datagrams; EmulatedPath and EndpointFilter
/// take every decision.
class Relay {
public:
    /// The place of a relay among the relays of a run: its name (empty for a single relay), all
    /// sockets, its number, its number in the fates, and its lane to the records.
    struct Among {
        std::string name;
        OwnSockets& own;
        std::uint32_t number = 0;
        std::uint32_t recorded_as = 0;
        Recorder::Lane& recorder;
    };

    /// Binds both sockets. Throws std::system_error when one cannot be bound. The paths and
    /// everything that `among` refers to must outlive the relay.
    Relay(const Endpoints& endpoints, Paths& paths, const Among& among);
    Relay(const Relay&) = delete;
    Relay& operator=(const Relay&) = delete;
    ~Relay() = default;

    /// Takes the datagrams that have arrived, at most one batch a side, so that a flood cannot
    /// delay what is due, and at once sends those that are not delayed. Conditions that change in
    /// the meantime affect the datagrams that arrived after the change.
    void receive();
    /// Takes the datagrams that have arrived on one side, like receive().
    void receive_from_a() { pass(a_, b_); }
    void receive_from_b() { pass(b_, a_); }

    /// Sends the datagrams of a path, or of a flow beside it, that are due at `now`. The two sides
    /// take turns, with a limit so that arrivals do not have to wait long. The remaining datagrams
    /// stay due.
    void release(EmulatedPath& path, base::TimePoint now);

    /// The reason why a datagram was dropped before the path saw it.
    enum class Refusal : std::uint8_t { is_own, not_allowed, not_the_peer, side_is_taken };

    /// The sender of a dropped datagram, and the reason.
    struct Stranger {
        net::Endpoint who;
        std::optional<net::Endpoint> owner; // the endpoint that this side accepts
        base::TimePoint owner_heard{};
        Refusal why = Refusal::is_own;
        base::TimePoint at{};
    };

    /// One side of the relay, and the direction that begins there.
    struct Side {
        Side(CaptureSide which, const Endpoints& endpoints, const Link& from_here);

        CaptureSide side;
        Direction direction; // direction of datagrams from this side
        net::UdpSocket socket;
        net::Endpoint local;
        EndpointFilter<net::Endpoint> filter;
        std::optional<net::AddressSet> allowed; // senders that may be adopted; nullopt: any
        const Link& link;                       // the link in that direction
        std::uint64_t strangers = 0; // datagrams from any other address, our own among them
        RateLimit notice{};
        std::optional<Stranger> stranger{}; // a stranger that was not reported yet

        [[nodiscard]] Entrance entrance() const { return {side, local}; }
        [[nodiscard]] Exit exit() { return {side, socket, local, filter.address()}; }

        void on_stranger(const net::Received& datagram, Refusal why);
    };

    /// Returns the next message for the user: a side's new peer or a stranger, each once. nullopt:
    /// no message. After a stranger, the next stranger of that side is named only after a pause.
    [[nodiscard]] std::optional<std::string> next_notice();

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const EmulatedPath& path() const { return path_; }
    [[nodiscard]] const Side& a() const { return a_; }
    [[nodiscard]] const Side& b() const { return b_; }

private:
    void pass(Side& from, Side& to);
    [[nodiscard]] std::optional<Refusal> refusal_of(Side& from, const net::Received& datagram);
    [[nodiscard]] Way way(EmulatedPath& path, Direction direction) const
    {
        return {path, direction, recorder_, recorded_as_, number_};
    }

    std::string name_;
    Paths& paths_;
    EmulatedPath& path_;
    Recorder::Lane& recorder_;
    std::uint32_t number_;
    std::uint32_t recorded_as_;
    OwnSockets& own_;
    Side a_;
    Side b_;
    bool has_adopted_ = false; // an adoption was not reported yet
};

} // namespace hapnet::emulator::ports

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/client_table.hpp"
#include "emulator/core/paths.hpp"
#include "emulator/core/rate_limit.hpp"
#include "emulator/endpoints.hpp"
#include "emulator/ports/batch.hpp"
#include "emulator/ports/own_sockets.hpp"
#include "emulator/recorder.hpp"
#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/net/wait_set.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator::ports {

/// A server and its clients: each address that sends gets a socket of its own to the server, and
/// an emulated path of its own. Like a NAT for UDP, and for no address that it is not told to let
/// in. Moves datagrams; EmulatedPath, ClientTable and AddressSet take every decision.
class Upstream {
public:
    struct Setup {
        std::size_t clients_max = 64;
        base::Duration idle = std::chrono::seconds{60}; // silent for so long: forgotten
        bool named_by_address = false;                  // their paths; else by their numbers
    };

    /// A client and its path. `up` is from the client to the server.
    struct Client {
        Client(std::uint64_t number, const net::Endpoint& address, const ServerAndClients& places);

        std::uint64_t number; // from 1, by their first datagrams
        std::optional<net::Endpoint> address;
        std::optional<net::Endpoint> server;
        net::UdpSocket socket; // to the server
        net::Endpoint local;   // of it
        std::string name{};    // of its path
        EmulatedPath* path = nullptr;
        std::uint32_t recorded_as = 0;
        std::uint64_t strangers = 0; // datagrams to its socket that are not the server's
    };

    /// Of clients that have been forgotten.
    struct Departed {
        Statistics up;
        Statistics down;
        std::uint64_t strangers_down = 0;
        std::uint64_t overflowed_down = 0;
    };

    /// Binds the socket. Throws std::system_error when it cannot. The paths and the recorder
    /// outlive it.
    Upstream(ServerAndClients places, Setup setup, Paths& paths, Recorder& recorder);

    /// Takes what has arrived, at most one batch of each socket, and sends on at once what is not
    /// delayed.
    void receive();

    /// Sends what is due at `now`, and forgets who has been silent.
    void release(base::TimePoint now);

    /// When a client may be forgotten.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const;

    /// To wait for.
    [[nodiscard]] std::vector<int> descriptors() const
    {
        return {listening_.descriptor(), answers_.descriptor()};
    }

    /// A sentence about a client that was turned away, or that came; each once.
    [[nodiscard]] std::optional<std::string> next_notice();

    [[nodiscard]] const net::Endpoint& local() const { return local_; }
    [[nodiscard]] const net::Endpoint& server() const { return places_.server; }
    /// By their places; null where there is none.
    [[nodiscard]] const std::vector<std::unique_ptr<Client>>& clients() const { return clients_; }
    [[nodiscard]] std::uint64_t clients_seen() const { return table_.numbered(); }
    [[nodiscard]] std::uint64_t clients_forgotten() const { return forgotten_; }
    [[nodiscard]] const Departed& departed() const { return departed_; }
    /// Datagrams from addresses that may not be clients, and from those for which there was no
    /// place.
    [[nodiscard]] std::uint64_t strangers() const { return strangers_; }
    [[nodiscard]] std::uint64_t refused() const { return refused_; }
    [[nodiscard]] std::uint64_t overflowed() const { return listening_.overflowed(); }

private:
    [[nodiscard]] Client* client_of(const net::Received& datagram);
    [[nodiscard]] std::string name_of(const Client& client);
    void give_path(Client& client);
    void take_from_clients();
    void take_from_server(Client& client);
    void forget_idle(base::TimePoint now);
    void turn_away(const net::Received& datagram, const std::string& why);
    [[nodiscard]] Way way(Client& client, Direction direction)
    {
        return {*client.path, direction, recorder_, client.recorded_as};
    }
    [[nodiscard]] static Exit to_server(Client& client)
    {
        return {CaptureSide::b, client.socket, client.local, client.server};
    }
    [[nodiscard]] Exit to_client(Client& client)
    {
        return {CaptureSide::a, listening_, local_, client.address};
    }

    ServerAndClients places_;
    Setup setup_;
    Paths& paths_;
    Recorder& recorder_;
    net::UdpSocket listening_;
    net::Endpoint local_;
    OwnSockets own_;
    net::WaitSet answers_;
    ClientTable<net::Endpoint> table_;
    std::vector<std::unique_ptr<Client>> clients_;
    std::map<std::string, std::uint64_t> visits_; // by addresses, where they are names
    Departed departed_;
    std::uint64_t forgotten_ = 0;
    std::uint64_t strangers_ = 0;
    std::uint64_t refused_ = 0;
    RateLimit notice_;
    std::optional<std::string> untold_;
};

} // namespace hapnet::emulator::ports

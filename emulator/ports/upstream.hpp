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
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator::ports {

/// A server and its clients. Each address that sends gets a socket of its own to the server, and an
/// emulated path of its own. This works like a NAT for UDP, but only for permitted addresses.
/// Upstream moves datagrams; EmulatedPath, ClientTable and AddressSet take every decision.
///
/// The clients are in parts, which may work concurrently, each on a thread of its own. Where there
/// are several parts, the kernel distributes the clients by their addresses.
class Upstream {
public:
    struct Setup {
        std::size_t clients_max = 64;
        base::Duration idle = std::chrono::seconds{60}; // silent clients are forgotten after this
        // Paths of clients are named by address; false: by number
        bool named_by_address = false;
    };

    /// A client and its path. `up` is from the client to the server.
    struct Client {
        Client(std::uint64_t number, const net::Endpoint& address, const ServerAndClients& places);

        std::uint64_t number; // from 1, in the order of first datagrams
        std::optional<net::Endpoint> address;
        std::optional<net::Endpoint> server;
        net::UdpSocket socket; // its socket towards the server
        net::Endpoint local;   // address of `socket`
        std::string name{};    // name of its path
        EmulatedPath* path = nullptr;
        std::uint32_t recorded_as = 0;
        std::uint64_t strangers = 0; // datagrams to `socket` from others than the server
    };

    /// The statistics of one flow.
    struct FlowSums {
        Statistics up;
        Statistics down;
    };

    /// Sums over the clients that have been forgotten.
    struct Departed {
        Statistics up; // datagrams that belong to no flow
        Statistics down;
        std::vector<FlowSums> flows; // sums of the flows, in the profile's order
        std::uint64_t strangers_down = 0;
        std::uint64_t overflowed_down = 0;
        std::uint64_t unreachable_up = 0;
        std::uint64_t count = 0;
    };

    class Part;

    /// Binds the sockets. Makes one part for each of the paths. Throws std::system_error when a
    /// socket cannot be bound. The paths and the recorder, which has as many lanes, must outlive
    /// it.
    Upstream(ServerAndClients places, Setup setup, const std::vector<std::unique_ptr<Paths>>& paths,
             Recorder& recorder);

    [[nodiscard]] std::vector<std::unique_ptr<Part>>& parts() { return parts_; }

    // Facts about all parts together. Call these functions only while no part is at work.

    [[nodiscard]] const net::Endpoint& local() const;
    /// Returns the addresses that the sockets are bound to, except the sockets to the server.
    [[nodiscard]] std::vector<net::Endpoint> locals() const { return {local()}; }
    [[nodiscard]] const net::Endpoint& server() const { return common_.places.server; }
    /// Returns the clients, in the order of their numbers.
    [[nodiscard]] std::vector<const Client*> clients() const;
    [[nodiscard]] std::uint64_t clients_seen() const { return common_.numbered; }
    [[nodiscard]] Departed departed() const;
    /// Returns the number of datagrams from addresses that may not be clients, and from those for
    /// which there was no place.
    [[nodiscard]] std::uint64_t strangers() const;
    [[nodiscard]] std::uint64_t refused() const;
    [[nodiscard]] std::uint64_t overflowed() const;
    /// Returns the number of answers from clients that no program listens there.
    [[nodiscard]] std::uint64_t unreachable() const;

private:
    /// Data that all parts share.
    struct Common {
        ServerAndClients places;
        Setup setup;
        Recorder& recorder;
        OwnSockets own{};
        std::mutex lock{}; // guards the members below when clients come and go
        std::uint64_t numbered = 0;
        std::size_t present = 0;
    };

    Common common_;
    std::vector<std::unique_ptr<Part>> parts_;
};

/// A part of the clients: those whose datagrams arrive at its socket.
class Upstream::Part {
public:
    /// `common`, `paths` and `recorder` have to outlive the part.
    Part(Common& common, net::UdpSocket listening, Paths& paths, Recorder::Lane& recorder);

    /// Takes the datagrams that have arrived, at most one batch of each socket, and at once sends
    /// those that are not delayed.
    void receive();

    /// Sends the datagrams that are due at `now`, and forgets clients that have been silent.
    void release(base::TimePoint now);

    /// Returns the time when a client may have to be forgotten.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const { return next_look_; }

    /// Returns the descriptors to wait for.
    [[nodiscard]] std::vector<int> descriptors() const
    {
        return {listening_.descriptor(), answers_.descriptor()};
    }

    /// Returns a sentence about a new client, or about one that was refused, each once.
    [[nodiscard]] std::optional<std::string> next_notice();

private:
    friend class Upstream;

    [[nodiscard]] Client* client_of(const net::Received& datagram);
    [[nodiscard]] std::unique_ptr<Client> admit(const net::Received& datagram, std::size_t place);
    [[nodiscard]] std::string name_of(const Client& client);
    void refuse(const net::Received& datagram, const std::string& why);
    void take_from_clients();
    void take_from_server(Client& client);
    void forget_idle(base::TimePoint now);
    void forget(std::size_t place);
    void turn_away(const net::Received& datagram, const std::string& why);
    [[nodiscard]] Way way(Client& client, EmulatedPath& path, Direction direction)
    {
        return {path, direction, recorder_, client.recorded_as};
    }
    [[nodiscard]] static Exit to_server(Client& client)
    {
        return {CaptureSide::b, client.socket, client.local, client.server};
    }
    [[nodiscard]] Exit to_client(Client& client)
    {
        return {CaptureSide::a, listening_, local_, client.address};
    }

    Common& common_;
    Paths& paths_;
    Recorder::Lane& recorder_;
    net::UdpSocket listening_;
    net::Endpoint local_;
    net::WaitSet answers_;
    ClientTable<net::Endpoint> table_;
    std::vector<std::unique_ptr<Client>> clients_; // indexed by the places in table_
    std::vector<Client*> by_path_;                 // indexed by the numbers of paths, also of flows
    std::map<std::string, std::uint64_t> visits_; // visits so far by each address that names a path
    std::optional<base::TimePoint> next_look_;    // next search for idle clients
    Departed departed_;
    std::uint64_t strangers_ = 0;
    std::uint64_t refused_ = 0;
    RateLimit notice_;
    std::optional<std::string> untold_;
};

} // namespace hapnet::emulator::ports

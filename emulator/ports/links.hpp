// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/paths.hpp"
#include "emulator/endpoints.hpp"
#include "emulator/ports/own_sockets.hpp"
#include "emulator/ports/relay.hpp"
#include "emulator/recorder.hpp"
#include "proto/base/time.hpp"
#include "proto/net/wait_set.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::emulator::ports {

/// The relays of a run: the only one, which has no name, or those of several links. They are
/// distributed over parts, which may work concurrently, each on a thread of its own.
class Links {
public:
    using Places = std::vector<NamedEndpoints>;

    /// A part of the relays.
    class Part {
    public:
        /// Takes the datagrams that have arrived, at most one batch of each socket that has any;
        /// see Relay::receive().
        void receive();

        /// Sends the datagrams that are due at `now`.
        void release(base::TimePoint now);

        /// Returns the descriptors to wait for.
        [[nodiscard]] std::vector<int> descriptors() const;

        /// Returns when to call release() even if no datagram is due and no conditions change.
        [[nodiscard]] static std::optional<base::TimePoint> next_deadline() { return std::nullopt; }

        /// Returns a sentence about one of the links; see Relay::next_notice().
        [[nodiscard]] std::optional<std::string> next_notice();

    private:
        friend class Links;
        void add(Relay& relay, Paths& paths);

        std::optional<net::WaitSet> ready_; // nullopt: there is only one relay
        Paths* paths_ = nullptr;
        std::vector<Relay*> relays_;  // in the order of add()
        std::vector<Relay*> by_path_; // indexed by the numbers of paths, also of flows
    };

    /// Binds all sockets. Makes one part for each of the paths, and distributes the links over them
    /// in turn. Throws std::system_error when a socket cannot be bound. The paths and the recorder,
    /// which has as many lanes, must outlive the links.
    Links(const Places& places, const std::vector<std::unique_ptr<Paths>>& paths,
          Recorder& recorder);

    /// Returns the part that the link at this place belongs to.
    [[nodiscard]] static std::size_t part_of(std::size_t place, std::size_t parts)
    {
        return place % parts;
    }

    [[nodiscard]] std::vector<std::unique_ptr<Part>>& parts() { return parts_; }

    /// Returns the relays, in the order of their places.
    [[nodiscard]] const std::vector<std::unique_ptr<Relay>>& relays() const { return relays_; }

    /// Returns the addresses that the sockets are bound to.
    [[nodiscard]] std::vector<net::Endpoint> locals() const;

private:
    OwnSockets own_;
    std::vector<std::unique_ptr<Relay>> relays_;
    std::vector<std::unique_ptr<Part>> parts_;
};

} // namespace hapnet::emulator::ports

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

/// The relays of a run: the only one, which has no name, or those of several links. They are dealt
/// out to parts, which may be at work side by side, each on a thread of its own.
class Links {
public:
    using Places = std::vector<NamedEndpoints>;

    /// A part of the relays.
    class Part {
    public:
        /// Takes what has arrived, at most one batch of each socket that has something; see
        /// Relay::receive().
        void receive();

        /// Sends what is due at `now`.
        void release(base::TimePoint now);

        /// The descriptors to wait for.
        [[nodiscard]] std::vector<int> descriptors() const;

        /// Returns when to call release() though no datagram is due and no conditions change.
        [[nodiscard]] static std::optional<base::TimePoint> next_deadline() { return std::nullopt; }

        /// A sentence about one of the links; see Relay::next_notice().
        [[nodiscard]] std::optional<std::string> next_notice();

    private:
        friend class Links;
        void add(Relay& relay, Paths& paths);

        std::optional<net::WaitSet> ready_; // nullopt: there is only one relay
        Paths* paths_ = nullptr;
        std::vector<Relay*> relays_;  // in the order of add()
        std::vector<Relay*> by_path_; // indexed by the numbers of paths, also of flows
    };

    /// Binds all sockets. A part for each of the paths: the links are dealt out in turn. Throws
    /// std::system_error when it cannot. The paths and the recorder, with as many lanes, outlive
    /// it.
    Links(const Places& places, const std::vector<std::unique_ptr<Paths>>& paths,
          Recorder& recorder);

    /// Returns the part that the link at this place belongs to.
    [[nodiscard]] static std::size_t part_of(std::size_t place, std::size_t parts)
    {
        return place % parts;
    }

    [[nodiscard]] std::vector<std::unique_ptr<Part>>& parts() { return parts_; }

    /// The relays, in the order of their places.
    [[nodiscard]] const std::vector<std::unique_ptr<Relay>>& relays() const { return relays_; }

    /// The addresses that the sockets are bound to.
    [[nodiscard]] std::vector<net::Endpoint> locals() const;

private:
    OwnSockets own_;
    std::vector<std::unique_ptr<Relay>> relays_;
    std::vector<std::unique_ptr<Part>> parts_;
};

} // namespace hapnet::emulator::ports

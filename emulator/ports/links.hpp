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

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::emulator::ports {

/// The relays of a run: the only one, which has no name, or those of several links.
class Links {
public:
    using Places = std::vector<NamedEndpoints>;

    /// Binds all sockets. Throws std::system_error when it cannot. The paths and the recorder
    /// outlive it.
    Links(const Places& places, Paths& paths, Recorder& recorder);

    /// Takes what has arrived, at most one batch of each socket that has something; see
    /// Relay::receive().
    void receive();

    /// Sends what is due at `now`.
    void release(base::TimePoint now);

    /// To wait for.
    [[nodiscard]] std::vector<int> descriptors() const;

    /// When release() is to be called though no datagram is due and no conditions change.
    [[nodiscard]] static std::optional<base::TimePoint> next_deadline() { return std::nullopt; }

    /// A sentence about one of the links; see Relay::next_notice().
    [[nodiscard]] std::optional<std::string> next_notice();

    [[nodiscard]] const std::vector<std::unique_ptr<Relay>>& relays() const { return relays_; }

private:
    OwnSockets own_;
    std::optional<net::WaitSet> ready_; // of several links
    std::vector<std::unique_ptr<Relay>> relays_;
};

} // namespace hapnet::emulator::ports

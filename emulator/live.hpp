// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/emulation.hpp"
#include "emulator/control_server.hpp"
#include "emulator/core/director.hpp"
#include "emulator/core/profile/profile.hpp"
#include "emulator/relay.hpp"
#include "proto/base/time.hpp"

#include <functional>
#include <optional>
#include <string>

namespace hapnet::emulator {

/// Changes the conditions of a running relay: by the timeline of its profile, and for those who ask
/// for it over the control socket.
class Live {
public:
    struct Setup {
        Profile profile;                   // that of the start; its seed is that of the run
        std::optional<std::string> socket; // nullopt: no control socket
        std::function<std::string()> statistics_json;
    };

    /// Throws std::system_error when the socket cannot be made.
    Live(Setup setup, Relay& relay);
    Live(const Live&) = delete;
    Live& operator=(const Live&) = delete;

    /// Readable when update() has something to do; -1 (which nobody waits for) without a socket.
    [[nodiscard]] int descriptor() const { return server_ ? server_->descriptor() : -1; }

    /// When update() is to be called again although descriptor() is not readable.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const;

    /// Makes the changes that are due and does a little for the clients.
    void update(base::TimePoint now);

    /// Another profile, from now on; its timeline counts from now.
    void apply(const Profile& profile, base::TimePoint now);

    [[nodiscard]] const Director& director() const { return director_; }

private:
    Relay& relay_;
    Director director_;
    Emulation emulation_;
    std::optional<ControlServer> server_;
};

} // namespace hapnet::emulator

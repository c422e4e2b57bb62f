// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/live/pace.hpp"
#include "lab/live/session.hpp"
#include "proto/control/core/conversation.hpp"

#include <functional>
#include <string>

namespace hapnet::lab::live {

/// A session in virtual time as the clients of its control sockets see it: an emulator and peers
/// as they are in real time, and its pace. Both parts outlive it.
struct Controlled {
    Session& session;
    Pace& pace;
    /// Keeps the text of an experiment; gives the name of its file.
    std::function<base::Result<std::string>(const std::string& text)> save;
    /// Ends it, as SIGTERM does.
    std::function<void()> stop;
};

/// The socket of the network and of the pace: requests of an emulator, and `pace`.
[[nodiscard]] control::Subject subject_of(const Controlled& controlled);

/// The socket of a peer, which is looked at. A stop ends the session, of all its peers.
[[nodiscard]] control::Subject peer_subject(const Controlled& controlled, std::size_t seat);

} // namespace hapnet::lab::live

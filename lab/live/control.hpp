// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "lab/live/pace.hpp"
#include "lab/live/recording.hpp"
#include "lab/live/session.hpp"
#include "proto/control/core/conversation.hpp"

#include <functional>
#include <string>

namespace hapnet::lab::live {

/// A session in virtual time, or a Recording of one, as the clients of its control sockets see it:
/// as an emulator and peers like those in real time, with a pace. Session and pace outlive it.
template <typename Played>
struct Controlled {
    Played& session;
    Pace& pace;
    /// Saves an experiment, and the motion of its hand. Returns the name of its file.
    std::function<base::Result<std::string>(experiment::Experiment saved)> save;
    /// Ends the session, as SIGTERM does.
    std::function<void()> stop;
};

/// Returns the subject of the socket of the network and of the pace. It answers the requests of an
/// emulator, and `pace`.
template <typename Played>
[[nodiscard]] control::Subject subject_of(const Controlled<Played>& controlled);

/// Returns the subject of the socket of a peer, which can only be watched. A stop ends the session
/// of all peers.
template <typename Played>
[[nodiscard]] control::Subject peer_subject(const Controlled<Played>& controlled, std::size_t seat);

} // namespace hapnet::lab::live

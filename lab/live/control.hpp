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
/// an emulator and peers as they are in real time, and its pace. Both parts outlive it.
template <typename Played>
struct Controlled {
    Played& session;
    Pace& pace;
    /// Keeps an experiment, and the way of its hand; gives the name of its file.
    std::function<base::Result<std::string>(experiment::Experiment saved)> save;
    /// Ends it, as SIGTERM does.
    std::function<void()> stop;
};

/// The socket of the network and of the pace: requests of an emulator, and `pace`.
template <typename Played>
[[nodiscard]] control::Subject subject_of(const Controlled<Played>& controlled);

/// The socket of a peer, which is looked at. A stop ends the session, of all its peers.
template <typename Played>
[[nodiscard]] control::Subject peer_subject(const Controlled<Played>& controlled, std::size_t seat);

} // namespace hapnet::lab::live

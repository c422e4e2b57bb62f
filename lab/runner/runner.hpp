// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/parts.hpp"
#include "lab/runner/session_store.hpp"
#include "proto/net/stop_signal.hpp"

#include <atomic>
#include <functional>
#include <vector>

namespace hapnet::lab {

/// Plays one session; gives up soon after `stop` became true, and then fails.
using StoppablePlay =
    std::function<base::Result<Played>(const SessionSpec&, const std::atomic<bool>& stop)>;

/// Plays a session on this thread, in virtual time.
[[nodiscard]] base::Result<Played> play_in_virtual_time(const SessionSpec& spec,
                                                        const std::atomic<bool>& stop);

/// How far a run has come.
struct RunProgress {
    std::size_t parts = 0;
    std::size_t parts_done = 0;
    SessionStore::Counts sessions;
};

/// What carries out an experiment: threads, one part each at a time.
struct Runner {
    SessionStore& store;
    StoppablePlay play;
    unsigned jobs = 1;
    /// Called on the caller's thread every 20 ms, and at the end.
    std::function<void(const RunProgress&)> on_progress;
};

/// The findings of all parts, in their order: the same for any number of jobs. nullopt when `stop`
/// was requested before the end; what was played until then is in the store. Throws what a thread
/// has thrown.
[[nodiscard]] base::Result<std::optional<std::vector<Finding>>>
carry_out_all(const Experiment& experiment, const Criteria& criteria, const Runner& runner,
              net::StopSignal& stop);

} // namespace hapnet::lab

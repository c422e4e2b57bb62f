// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"
#include "lab/runner/session_store.hpp"
#include "proto/net/stop_signal.hpp"

#include <atomic>
#include <functional>
#include <span>
#include <vector>

namespace hapnet::lab::runner {

/// Plays one session. It gives up soon after `stop` became true, and then fails.
using StoppablePlay = std::function<base::Result<experiment::PlayedSession>(
    const experiment::SessionSpec&, const std::atomic<bool>& stop)>;

/// Plays a session on this thread, in virtual time.
[[nodiscard]] base::Result<experiment::PlayedSession>
play_in_virtual_time(const experiment::SessionSpec& spec, const std::atomic<bool>& stop);

/// A job and its experiment.
struct Assignment {
    const experiment::Experiment* experiment = nullptr;
    experiment::Job job{};
};

/// The progress of a run.
struct RunProgress {
    std::size_t jobs = 0;
    std::size_t jobs_done = 0;
    SessionStore::Counts sessions;
};

/// The means to run an experiment: threads that each do one job at a time.
struct Runner {
    SessionStore& store;
    StoppablePlay play;
    unsigned threads = 1;
    /// The function that is called on the caller's thread every 20 ms, and at the end.
    std::function<void(const RunProgress&)> on_progress;
};

/// Returns the results of all jobs, in their order. They are the same for any number of threads.
/// nullopt when `stop` was requested before the end; the sessions played until then are in the
/// store. Rethrows the exception of a thread.
[[nodiscard]] base::Result<std::optional<std::vector<experiment::JobResult>>>
run_all(std::span<const Assignment> jobs, const metrics::Criteria& criteria, const Runner& runner,
        net::StopSignal& stop);

} // namespace hapnet::lab::runner

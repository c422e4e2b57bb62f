// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/cli/options.hpp"
#include "lab/metrics/metrics.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"
#include "proto/base/value_kind.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hapnet::lab {

/// One algorithm of a play.
struct PlayedSession {
    std::string algorithm;
    metrics::Metrics metrics;
};
constexpr auto fields_of(base::Tag<PlayedSession>)
{
    return base::fields(
        "played session",
        base::member("algorithm", &PlayedSession::algorithm, "What the experiment calls it."),
        base::member("metrics", &PlayedSession::metrics,
                     "What it is measured by: docs/design/metrics.md."));
}

/// The output of `play --json`.
struct PlayReport {
    device::Task task{};
    std::uint64_t seed = 0;
    base::Duration duration{};
    std::string digest;
    std::vector<PlayedSession> sessions;
};
constexpr auto fields_of(base::Tag<PlayReport>)
{
    using P = PlayReport;
    return base::fields(
        "play", base::member("task", &P::task, "The task that was played."),
        base::member("seed", &P::seed, "The seed of the session."),
        base::member("duration_s", &P::duration, "The length of the session."),
        base::member("digest", &P::digest,
                     "Of all that the hands felt and the bodies did: equal bits, equal digest."),
        base::member("sessions", &P::sessions, "The session of each algorithm."));
}

/// Plays one session in virtual time: to its end, for its numbers, or with a control socket for
/// clients that watch it, until it is stopped. Returns the exit code. Fails on bad input. Throws
/// std::system_error when a socket or a file cannot be made.
[[nodiscard]] base::Result<int> play_session(const PlayCommand& command);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/path.hpp"
#include "lab/records/session.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::lab::records {

/// The lowest, the median and the highest delay, in milliseconds.
struct DelaySpan {
    double low = 0.0;
    double median = 0.0;
    double high = 0.0;
};

/// The messages of one direction that were sent within a stretch of a session.
struct PathStretch {
    double from_s = 0.0; // since the session's start, on A's clock
    double to_s = 0.0;
    /// The number of messages sent. Losses after the highest sequence that arrived are unknown.
    std::uint64_t sent = 0;
    std::uint64_t received = 0;
    std::optional<DelaySpan> delay_ms{}; // nullopt: no message arrived

    /// Returns the share of lost messages; nullopt: none was sent.
    [[nodiscard]] std::optional<double> loss() const
    {
        if (sent == 0) return std::nullopt;
        return 1.0 - static_cast<double>(received) / static_cast<double>(sent);
    }
};

/// One direction of a session over time. A message counts once, however many copies arrived.
struct PathOverTime {
    std::vector<PathStretch> stretches; // consecutive, up to the last one with a message sent
    std::vector<double> delays_ms;      // delays of all messages in the stretches
};

struct PathsOverTime {
    double stretch_s = 0.0;
    PathOverTime a_to_b;
    PathOverTime b_to_a;
};

/// Returns both directions in stretches of 1, 2 or 5 times a power of ten: at most 100 of them,
/// with 50 messages each on average where there are enough messages. The times at which lost
/// messages were sent are assumed to lie evenly between those of the messages around them that
/// arrived.
[[nodiscard]] PathsOverTime paths_over_time(const Session& session);

} // namespace hapnet::lab::records

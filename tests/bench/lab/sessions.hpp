// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/play.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::bench {

/// A session to play, and its hands.
struct Session {
    lab::virtual_time::Setting setting;
    int steps_a_read = 0; // steps of the hands per read; 0: exact hands, as everywhere else
};

/// Returns a task under the paper's 160 ms, with this algorithm on both sides.
[[nodiscard]] Session session_of(device::Task task, std::string_view algorithm);

/// The result of a session, and the time that it took.
struct Result {
    lab::virtual_time::Trace trace;
    double wall_s = 0.0;

    /// Returns the wall time for one second of the session.
    [[nodiscard]] double wall_s_per_s() const { return wall_s / base::to_seconds(trace.simulated); }
};
[[nodiscard]] Result played(const Session& session);

/// |x_L - x_R| of the cubes, millimetres: a line of the paper's Table 1.
struct Figures {
    double mean = 0.0;
    double std = 0.0;
    double max = 0.0;
};
[[nodiscard]] Figures figures_of(const lab::virtual_time::Trace& trace);

} // namespace hapnet::bench

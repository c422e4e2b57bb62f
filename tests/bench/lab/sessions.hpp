// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/play.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::bench {

/// A session to be played, by whose hands.
struct Session {
    lab::virtual_time::Setting setting;
    int steps_a_read = 0; // of the hands; 0: exact ones, as everywhere else
};

/// A task under the paper's 160 ms, by an algorithm of this name on both sides.
[[nodiscard]] Session session_of(device::Task task, std::string_view algorithm);

/// What came of it, and how long it took.
struct Result {
    lab::virtual_time::Trace trace;
    double wall_s = 0.0;

    /// The wall time of one second of a session's.
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

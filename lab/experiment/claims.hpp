// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hapnet::lab::experiment {

/// Network conditions under which the claims of docs/results/beat.md are judged. They are the same
/// between any two peers, in both directions.
struct ClaimCell {
    std::string_view name; // name of the condition in sessions.csv
    std::int64_t delay_ms = 0;
    std::int64_t jitter_ms = 0; // mean of a uniform jitter from 0 to twice this; messages overtake
    std::int64_t loss_percent = 0;
    std::int64_t burst_of_100 = 0; // messages lost in a row, of every 100
    std::vector<device::Task> tasks{};
    std::string_view hands = "nominal";
    std::uint32_t peers = 2;
};
[[nodiscard]] std::span<const ClaimCell> claim_cells();

/// The cell whose sessions end in silence: delay, jitter and loss at once.
inline constexpr std::string_view settled_cell = "all";

/// Returns the jobs of each algorithm, cell, task and seed, in this order. After them comes, for
/// each algorithm and seed, a job that measures the distance of the copies after silence.
[[nodiscard]] std::vector<Job> claim_jobs(const Experiment& experiment);

/// Returns the greatest distance between two copies of the body, in metres, a given time after all
/// hands let go and the network became perfect. The session is played twice: the first time finds
/// the moment when all hands let go.
[[nodiscard]] base::Result<double> apart_after_silence(const virtual_time::Setting& setting,
                                                       base::Duration after);

} // namespace hapnet::lab::experiment

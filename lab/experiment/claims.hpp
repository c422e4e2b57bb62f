// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/jobs.hpp"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace hapnet::lab::experiment {

/// Conditions under which the claims of docs/results/beat.md are judged: the same between any two
/// peers, both ways.
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

/// The cell in which silence is tried: delay, jitter and loss at once.
inline constexpr std::string_view settled_cell = "all";

/// The jobs of each algorithm, cell, task and seed, in this order. Then follows, for each algorithm
/// and seed, a job that measures how far copies are apart after silence.
[[nodiscard]] std::vector<Job> claim_jobs(const Experiment& experiment);

/// The greatest distance between two copies of the body, a given time after all hands let go and
/// the network became perfect, metres. The session is played twice: the first time finds when that
/// is.
[[nodiscard]] base::Result<double> apart_after_silence(const virtual_time::Setting& setting,
                                                       base::Duration after);

} // namespace hapnet::lab::experiment

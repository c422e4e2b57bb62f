// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/path_stretches.hpp"
#include "proto/page/figure.hpp"

#include <cstddef>
#include <string_view>
#include <vector>

namespace hapnet::lab::report {

/// The size of figures of a session over time, which are placed one below the other.
inline constexpr page::Size plot_size{900.0, 230.0};
/// The greatest number of points in a curve of shares.
inline constexpr std::size_t share_points_max = 1000;

/// Returns the delay and the loss of both directions of a session over time; no figures where no
/// message arrived. `arrival` names the event at which a delay ends.
[[nodiscard]] std::vector<page::Figure> path_figures(const records::PathsOverTime& paths,
                                                     std::string_view arrival);

/// Returns, for each direction, the share of the messages that took at most a given time; no
/// figures where no message arrived.
[[nodiscard]] std::vector<page::Figure> delay_distribution(const records::PathsOverTime& paths);

} // namespace hapnet::lab::report

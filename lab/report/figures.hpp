// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/results.hpp"
#include "proto/page/figure.hpp"

#include <string>
#include <vector>

namespace hapnet::lab::report {

/// Figures of a section that belong together, below a heading or after a line of text. The title is
/// empty when there is neither.
struct FigureGroup {
    std::string title;
    std::vector<page::Figure> figures;
    /// The files from which the figures were made, besides those with their numbers.
    std::vector<std::string> origins{};
};
using FigureGroups = std::vector<FigureGroup>;

// These functions return the figures of each section. They return none where the folder lacks the
// tables.

[[nodiscard]] FigureGroups table1_figures(const results::Results& results);
/// The results of each seed of the closed-loop tasks.
[[nodiscard]] FigureGroups tasks_figures(const results::Results& results);
/// Limits of delay and jitter.
[[nodiscard]] FigureGroups fig6a_figures(const results::Results& results);
/// Limits of random loss and burst loss.
[[nodiscard]] FigureGroups fig6b_figures(const results::Results& results);
[[nodiscard]] FigureGroups curves_figures(const results::Results& results);
/// Limits of the interval between messages. The other requirements on a network are in a table.
[[nodiscard]] FigureGroups requirements_figures(const results::Results& results);
/// Limits by filter and hands.
[[nodiscard]] FigureGroups trust_figures(const results::Results& results);
/// The results against the values of a parameter: limits, and each measure in each task.
[[nodiscard]] FigureGroups axis_figures(const results::Results& results);
/// Errors against cost: a group for each parameter and algorithm.
[[nodiscard]] FigureGroups precision_figures(const results::Results& results);
/// The share of points, over several parameters, at which each algorithm is usable.
[[nodiscard]] FigureGroups points_figures(const results::Results& results);
[[nodiscard]] FigureGroups fig7_figures(const results::Results& results);
[[nodiscard]] FigureGroups qos_figures(const results::Results& results);
/// The numbers of each claim with its limits: a figure for each unit.
[[nodiscard]] FigureGroups claims_figures(const results::Results& results);
[[nodiscard]] FigureGroups real_time_figures(const results::Results& results);
/// A group for each recorded session.
[[nodiscard]] FigureGroups session_figures(const results::Results& results);

} // namespace hapnet::lab::report

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/fate.hpp"
#include "proto/page/figure.hpp"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

// The figures of a run's page; nullopt where there is nothing to be shown.

/// Returns the description of a direction for people.
[[nodiscard]] constexpr std::string_view words_on(Direction direction)
{
    return direction == Direction::up ? "up (A to B)" : "down (B to A)";
}

/// A direction of a run.
struct RunDirection {
    Direction direction = Direction::up;
    const nlohmann::ordered_json& statistics; // statistics of this direction
    const Conditions* conditions = nullptr;   // null: they changed during the run
    std::span<const Fate> fates;
    double spacing_s = 0.0; // mean time between two datagrams
};

/// Returns the densities of the delay: by the law, as drawn, and as measured.
[[nodiscard]] std::optional<page::Figure> delay_figure(const RunDirection& run);

/// Returns the distribution of the lateness, with the budget.
[[nodiscard]] std::optional<page::Figure> lateness_figure(const RunDirection& run,
                                                          double budget_us);

/// Returns the positions in the stream at which datagrams were lost; nullopt: none was lost.
[[nodiscard]] std::optional<page::Figure> loss_figure(const RunDirection& run);

/// Returns the lengths of the runs of losses, beside a geometric distribution with the law's mean.
[[nodiscard]] std::optional<page::Figure> loss_runs_figure(const RunDirection& run);

/// True if `change` is the last step of a ramp whose first step is `before`. The statistics keep
/// only these two steps of a ramp, while the generation counts every step.
[[nodiscard]] bool ends_ramp(const nlohmann::ordered_json& before,
                             const nlohmann::ordered_json& change);

/// The course of a run: one figure each for delay, loss, rate and queue, if they have values.
struct CourseFigures {
    std::vector<page::Figure> figures;
    std::string why_not_asked; // why figures lack the requested values; empty: they have them
};

/// Returns figures of the requested conditions and of the measurements over time. A change is a
/// step, and a ramp is a straight line. If a setting cannot be read from the statistics, such as
/// one that names a file, only the measurements are shown.
[[nodiscard]] CourseFigures course_figures(const Path& start,
                                           const nlohmann::ordered_json& statistics);

} // namespace hapnet::emulator::tools

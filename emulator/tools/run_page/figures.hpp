// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/fate.hpp"
#include "proto/page/figure.hpp"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>

namespace hapnet::emulator::tools {

// The figures of a run's page; nullopt where there is nothing to be shown.

/// A direction of a run.
struct RunDirection {
    Direction direction = Direction::up;
    const nlohmann::ordered_json& statistics; // of this direction
    const Conditions* conditions = nullptr;   // null: they changed
    std::span<const Fate> fates;
    double spacing_s = 0.0; // mean time between two datagrams
};

/// Delay as the law has it, as it was drawn and as it came out: densities.
[[nodiscard]] std::optional<page::Figure> delay_figure(const RunDirection& run);

/// The distribution of the lateness, with the budget.
[[nodiscard]] std::optional<page::Figure> lateness_figure(const RunDirection& run,
                                                          double budget_us);

/// Where in the stream datagrams were lost.
[[nodiscard]] std::optional<page::Figure> loss_figure(const RunDirection& run);

/// How long the runs of losses were, beside a geometric distribution with the law's mean.
[[nodiscard]] std::optional<page::Figure> loss_runs_figure(const RunDirection& run);

/// When the conditions changed.
[[nodiscard]] std::optional<page::Figure> changes_figure(const nlohmann::ordered_json& statistics);

} // namespace hapnet::emulator::tools

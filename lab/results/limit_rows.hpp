// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/parts.hpp"
#include "lab/results/rows.hpp"

#include <span>
#include <vector>

namespace hapnet::lab {

// The rows of an experiment of kind Limits. `findings` are those of all its parts.

/// Of each task, and after them of the worst of them.
[[nodiscard]] std::vector<LimitRow> make_limit_rows(const Experiment& experiment,
                                                    std::span<const Finding> findings);

/// Every session that a search played.
[[nodiscard]] std::vector<CurveRow> make_curve_rows(const Experiment& experiment,
                                                    const Criteria& criteria,
                                                    std::span<const Finding> findings);

[[nodiscard]] std::vector<ConventionRow> make_convention_rows(const Experiment& experiment,
                                                              const Convention& convention,
                                                              std::span<const Finding> findings);

} // namespace hapnet::lab

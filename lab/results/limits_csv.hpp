// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/parts.hpp"

#include <span>
#include <string>

namespace hapnet::lab {

// The tables of an experiment of kind Limits. `findings` are those of all its parts.

/// Of each task, and of the worst of them.
[[nodiscard]] std::string limits_csv(const Experiment& experiment,
                                     std::span<const Finding> findings);

/// Every session that a search played.
[[nodiscard]] std::string curves_csv(const Experiment& experiment, const Criteria& criteria,
                                     std::span<const Finding> findings);

[[nodiscard]] std::string convention_csv(const Experiment& experiment, const Convention& convention,
                                         std::span<const Finding> findings);

} // namespace hapnet::lab

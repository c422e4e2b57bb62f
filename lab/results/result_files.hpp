// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/parts.hpp"
#include "lab/results/file.hpp"

#include <span>
#include <vector>

namespace hapnet::lab {

/// What an experiment found, as files: equal findings, equal bytes. `findings` are those of
/// parts_of(experiment), in that order. The error: sessions that nothing can be calibrated on.
[[nodiscard]] base::Result<std::vector<File>> results_of(const Experiment& experiment,
                                                         const Criteria& criteria,
                                                         std::span<const Finding> findings);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/parts.hpp"

#include <span>
#include <string>
#include <vector>

namespace hapnet::lab {

/// A file of a folder of results: docs/use/experiments.md says what its columns are.
struct ResultText {
    std::string name; // relative to the folder
    std::string text;
};

/// What an experiment found, as files: equal findings, equal bytes. `findings` are those of
/// parts_of(experiment), in that order. The error: sessions that nothing can be calibrated on.
[[nodiscard]] base::Result<std::vector<ResultText>> results_of(const Experiment& experiment,
                                                               const Criteria& criteria,
                                                               std::span<const Finding> findings);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"

#include <vector>

namespace hapnet::lab::experiment {

/// Returns experiments whose sessions and results, one after the other, are those of the whole. A
/// plane is divided into its points. An experiment of another kind is its only part. So the memory
/// that is needed at a time grows with a part, not with the whole.
[[nodiscard]] std::vector<Experiment> parts_of(const Experiment& experiment);

} // namespace hapnet::lab::experiment

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "proto/base/result.hpp"

#include <string>
#include <vector>

namespace hapnet::lab::experiment {

/// A point of an experiment with axes: the value of each, in their order.
using AxisValues = std::vector<std::string>;

/// The points of an experiment in the order of its results: every combination of the values of its
/// axes, of which the last runs first; or those of its latin hypercube, in which each of n points
/// has a range's n-th part, or a value of a list, that no other has before all have one. A pure
/// function of the axes and the hypercube: drawing one axis never shifts another. At most
/// points_max. The error says which axis has no points and what to write.
[[nodiscard]] base::Result<std::vector<AxisValues>> axis_points(const Experiment& experiment);

} // namespace hapnet::lab::experiment

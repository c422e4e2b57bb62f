// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "proto/base/result.hpp"

#include <string>
#include <vector>

namespace hapnet::lab::experiment {

/// A point of an experiment with axes: the value of each axis, in the order of the axes.
using AxisValues = std::vector<std::string>;

/// Returns the points of an experiment in the order of its results. They are all combinations of
/// the axes' values, where the last axis varies fastest, or the points of its latin hypercube. A
/// hypercube of n points divides a range into n parts, and each point gets another part. From a
/// list, no value recurs before all have been used. The result is a pure function of the axes and
/// the hypercube: drawing one axis never shifts another. There are at most points_max. The error
/// names the axis that has no points and what to write.
[[nodiscard]] base::Result<std::vector<AxisValues>> axis_points(const Experiment& experiment);

} // namespace hapnet::lab::experiment

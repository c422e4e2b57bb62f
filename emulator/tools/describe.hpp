// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/tools/predict.hpp"

#include <string>
#include <vector>

namespace hapnet::emulator::tools {

/// One sentence for each stage of a direction that does something, in the order of the stages, with
/// what theory says of it.
[[nodiscard]] std::vector<std::string> describe(const Conditions& conditions, const Stream& stream);

/// Effects on a stream that a user may not have meant, with the numbers that `prediction` found.
[[nodiscard]] std::vector<std::string> warnings(const Conditions& conditions, const Stream& stream,
                                                const DirectionPrediction& prediction);

/// Why mean and deviation of the delay are not known better, and what to do; "" where they have
/// settled. `changes`: the conditions have a timeline.
[[nodiscard]] std::string why_unsettled(const Conditions& conditions, const Stream& stream,
                                        const DirectionPrediction& prediction, bool changes);

} // namespace hapnet::emulator::tools

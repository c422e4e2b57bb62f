// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/tools/predict.hpp"

#include <string>
#include <vector>

namespace hapnet::emulator::tools {

/// Returns one sentence for each stage of a direction that has an effect, in the order of the
/// stages, with its theoretical properties.
[[nodiscard]] std::vector<std::string> describe(const Conditions& conditions, const Stream& stream);

/// Returns sentences about effects on a stream that a user may not have intended, with the numbers
/// of `prediction`.
[[nodiscard]] std::vector<std::string> warnings(const Conditions& conditions, const Stream& stream,
                                                const DirectionPrediction& prediction);

/// Returns why mean and deviation of the delay are not known more precisely, and what to do; "" if
/// they have settled. `changes`: the conditions have a timeline.
[[nodiscard]] std::string why_unsettled(const Conditions& conditions, const Stream& stream,
                                        const DirectionPrediction& prediction, bool changes);

} // namespace hapnet::emulator::tools

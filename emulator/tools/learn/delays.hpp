// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/delay.hpp"
#include "emulator/tools/learn/measurement.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

/// A law of delays with the fitted parameters: a constant and a jitter.
struct DelayModel {
    std::string_view name;
    base::Duration base{};
    DelayLaw jitter;
    double distance = 0.0;           // largest distance of the distribution functions
    std::optional<double> p_value{}; // Kolmogorov-Smirnov; nullopt: too few delays
};

/// The models that were fitted to the delays of a direction.
struct DelayFit {
    std::vector<DelayModel> models{};  // nearest first; only a constant if delays do not vary
    double correlation = 0.0;          // correlation of neighbours' normal scores
    base::Duration correlation_time{}; // 0: independent, or the spacing is not known
    std::size_t independent = 0;       // delays that were far enough apart for the test
};

/// Fits the models. `way` has at least one delay.
[[nodiscard]] DelayFit fit_delays(const MeasuredWay& way);

/// Returns `points` quantiles of the model, in ns, ascending: the i-th is at (i + 1/2) / points.
[[nodiscard]] std::vector<double> quantiles_of(const DelayModel& model, int points);

} // namespace hapnet::emulator::tools

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/learn/measurement.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::emulator::tools {

/// One regime that was found in a series.
struct RegimeFit {
    std::vector<std::uint8_t> is_own{}; // 1: row n is in this regime, drawn by probability
    double rows = 0.0;                  // expected number of rows
    double lost = 0.0;                  // expected number of lost ones among them
    double exits = 0.0;                 // expected number of times that it ended
    double stay_rows = 0.0;             // mean length of its stays, in rows
    std::vector<double> followers{};    // share in which each regime followed; sum 1
};

/// Regimes of a series, ascending by their mean delays.
struct RegimesFit {
    std::vector<RegimeFit> regimes{};
    double log_likelihood = 0.0;
    double bic = 0.0; // less is better (Schwarz, Annals of Statistics 6, 1978)
};

/// Fits `count` regimes, 1 to 4, to delays and losses together. The model is a hidden Markov chain
/// whose states have any distribution of delays, in at most 32 classes, and a share of losses. It
/// uses Baum and Welch's expectation-maximisation from several starting points. nullopt: a regime
/// is too short to be seen at the distance of the rows, or has fewer than ten stays.
[[nodiscard]] std::optional<RegimesFit> fit_regimes(const MeasuredWay& way, std::size_t count);

/// Returns the number of regimes of a series with the least BIC; 1 where there are none.
[[nodiscard]] std::size_t count_regimes(const MeasuredWay& way);

} // namespace hapnet::emulator::tools

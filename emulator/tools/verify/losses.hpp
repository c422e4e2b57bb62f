// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/tools/verify/result.hpp"
#include "emulator/tools/verify/tally.hpp"

namespace hapnet::emulator::tools {

// Tests of losses. For alpha see by_chance().

/// Tests the number of losses against the binomial law, for independent losses.
[[nodiscard]] TestResult test_count(const LossTally& tally, double share, double alpha);

/// Tests the share of losses against a normal law with the theoretical variance, for chains. Unable
/// when the run is equivalent to fewer than 100 independent losses (or datagrams that pass).
[[nodiscard]] TestResult test_share(const LossTally& tally, const LossTheory& theory, double alpha);

/// Tests if a loss makes the next one more or less likely: chi-square of the 2x2 table of a
/// datagram's fate and that of the next.
[[nodiscard]] TestResult test_independence(const LossTally& tally, double alpha);

/// Tests the number of runs, of losses and of other datagrams, against its law for independent
/// losses (Wald and Wolfowitz 1940).
[[nodiscard]] TestResult test_number_of_runs(const LossTally& tally, double alpha);

/// Tests the lengths of runs of losses against their law, by chi-square over bins in which at least
/// 5 are expected.
[[nodiscard]] TestResult test_run_lengths(const LossTally& tally, const RunLengths& law,
                                          double alpha);

/// Tests if two sequences of losses are independent. `memory`: the product of the correlations of
/// both sequences with their own pasts, datagram by datagram.
[[nodiscard]] TestResult test_unrelated(const PairTally& tally, double memory, double alpha);

} // namespace hapnet::emulator::tools

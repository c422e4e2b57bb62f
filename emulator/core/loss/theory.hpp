// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/law.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::emulator {

/// Datagrams at even distances, the first at the beginning of the run.
struct Arrivals {
    base::Duration spacing{}; // > 0
    std::uint64_t count = 0;  // > 0
};

/// What a law of loss amounts to in the long run; for lists and outages, which have an end, over
/// the arrivals in question. The laws in time depend on the spacing, no other does.
struct LossTheory {
    double share = 0.0;
    std::optional<double> mean_run{};        // of losses, in datagrams; nullopt: none, or endless
    std::optional<double> loss_after_loss{}; // probability; nullopt: nothing is lost
    /// The correlation of a state of the law with the next one, where it has one number for it.
    std::optional<double> decay{};
    /// The variance of the share that n datagrams lose, by that of independent losses, for large n:
    /// (1 + decay) / (1 - decay) for Gilbert's model; 0 for laws that leave nothing to chance.
    double variance_inflation = 0.0;
};

[[nodiscard]] LossTheory theory_of(const LossLaw& law, const Arrivals& arrivals);

/// How long runs of losses are.
struct RunLaw {
    std::vector<double> at_least; // [i]: the probability that a run has i + 1 datagrams or more
    double memory = 0.0;          // the correlation of what a run leaves behind with the next one
};

/// In closed form, for runs of up to `most` datagrams; nullopt for laws that have none, and where
/// nothing or everything is lost.
[[nodiscard]] std::optional<RunLaw> run_law_of(const LossLaw& law, base::Duration spacing,
                                               std::size_t most);

} // namespace hapnet::emulator

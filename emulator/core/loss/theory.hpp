// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace hapnet::emulator {

// Theoretical properties of a law of loss, known before anything is drawn: closed forms for people,
// and the properties by which a run is tested.

/// Datagrams at even distances, the first at the beginning of the run.
struct Arrivals {
    base::Duration spacing{}; // > 0
    std::uint64_t count = 0;  // > 0
};

/// The behaviour of a law of loss in the long run. For lists and outages, which have an end, it is
/// the behaviour over the given arrivals. Only the laws in time depend on the spacing.
struct LossTheory {
    double share = 0.0;
    std::optional<double> mean_run{};        // length in datagrams; nullopt: no runs, or endless
    std::optional<double> loss_after_loss{}; // probability; nullopt: nothing is lost
    /// The correlation of a state of the law with the next one, if one number describes it.
    std::optional<double> decay{};
    /// The variance of the share that n datagrams lose, divided by that of independent losses, for
    /// large n: (1 + decay) / (1 - decay) for Gilbert's model; 0 for laws that leave nothing to
    /// chance.
    double variance_inflation = 0.0;
    /// The correlation of a loss with the next one, as one number that is not an underestimate;
    /// nullopt for laws that draw nothing, or only a phase.
    std::optional<double> memory{};
};

/// Returns the theory of losses with this share. `both`: the probability that two neighbours are
/// lost.
[[nodiscard]] LossTheory theory_from_pairs(double share, double both);

/// Returns the theory of losses that are not drawn at random, in `runs` runs.
[[nodiscard]] LossTheory theory_from_counts(double count, double losses, double runs);

/// Adds the memory of losses that are drawn one by one.
[[nodiscard]] LossTheory with_memory(LossTheory theory);

/// Returns the theory of losses that repeat after `size` datagrams.
template <typename IsLost>
[[nodiscard]] LossTheory theory_of_period(std::size_t size, IsLost&& is_lost)
{
    double losses = 0.0;
    double runs = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
        if (!is_lost(i)) continue;
        losses += 1.0;
        if (!is_lost((i + size - 1) % size)) runs += 1.0;
    }
    return theory_from_counts(static_cast<double>(size), losses, runs);
}

// The properties of a law. Each is a test that emulator/tools/verify can do.

/// Each datagram is lost independently of the others. The test is of the number of losses, and of
/// the independence of neighbours.
struct IndependentLosses {
    double share = 0.0;
};

/// The share of losses in the long run, within the variance of the theory.
struct LongRunShare {
    LossTheory theory;
};

/// The lengths of runs of losses, for runs of up to at_least.size() datagrams.
struct RunLengths {
    static constexpr std::size_t most = 10'000; // longer runs share the last bin

    std::vector<double> at_least; // [i]: the probability that a run has i + 1 datagrams or more
    // Correlation of the states in which a run and the next run begin.
    double memory = 0.0;
};

/// Exactly `lost` of every `of` datagrams are lost from the first datagram on, at places that are
/// equally likely.
struct ExactBlocks {
    std::uint32_t lost = 0;
    std::uint32_t of = 0;
};

/// `lost` datagrams in a row of every `of` are lost, from `phase` on, or from wherever the first
/// burst begins.
struct RecurringBursts {
    std::uint32_t lost = 0;
    std::uint32_t of = 0;
    std::optional<std::uint32_t> phase{};
};

/// Exactly these datagrams are lost. Nothing is drawn.
struct SameLosses {
    std::vector<std::uint8_t> lost; // 1: lost; the index is the datagram's number
};

/// The share of losses among the datagrams that are judged in a state.
struct LossesInState {
    LossState state = LossState::none;
    double share = 0.0;
};

/// The probability that one state follows another. It can be tested whatever other laws do.
struct StateStep {
    LossState from = LossState::none;
    LossState to = LossState::none;
    double probability = 0.0;
};

/// The reason why nothing can be tested.
struct Untestable {
    std::string_view reason;
};

using LossProperty =
    std::variant<IndependentLosses, LongRunShare, RunLengths, ExactBlocks, RecurringBursts,
                 SameLosses, LossesInState, StateStep, Untestable>;

/// Facts about a run other than its losses.
struct RunFacts {
    std::uint64_t count = 0;                 // number of datagrams
    std::optional<base::Duration> spacing{}; // between datagrams, if they came evenly; > 0
};

/// Returns the losses of a law without random draws among the first `count` datagrams. It runs the
/// law's model.
template <typename Law>
[[nodiscard]] SameLosses same_losses(const Law& law, std::uint64_t count)
{
    const auto stream = base::Seed{}.stream("");
    typename Law::Model model{law, stream};
    SameLosses same;
    for (std::uint64_t number = 0; number < count; ++number) {
        same.lost.push_back(model.on_packet({.number = number}, stream) ? 1 : 0);
    }
    return same;
}

/// Returns the lengths of runs that continue with the same probability after each datagram; nullopt
/// unless it is in [0, 1).
[[nodiscard]] std::optional<RunLengths> geometric_runs(double goes_on);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hapnet::emulator::tools {

/// Consecutive datagrams that were all lost, or that all arrived.
struct LossRun {
    bool is_lost = false;
    std::size_t length = 0;
};

[[nodiscard]] std::vector<LossRun> runs_of(const std::vector<bool>& lost);

/// A Markov chain that steps once per datagram. Each of its states has a share of losses. Unused
/// states are never entered.
struct LossChain {
    static constexpr std::size_t states_max = 4;
    using Row = std::array<double, states_max>;

    std::array<Row, states_max> steps{}; // [from][to]
    Row loses{};
    Row shares{}; // share of datagrams in each state, in the long run
};

/// Returns the distribution of the lengths of runs of losses, or of arrivals, in a chain, up to
/// `most` datagrams: [i] is the probability that a run has at least (i + 1) datagrams.
[[nodiscard]] std::vector<double> run_lengths(const LossChain& chain, bool of_losses,
                                              std::size_t most);

/// Tests if runs of losses, or the runs of arrivals between them, follow a chain. Returns the
/// p-value of Pearson's chi-square of their lengths, in classes where at least 5 are expected.
/// Where runs are clustered, the chi-square is divided by the factor by which clusters increase the
/// variance (Rao and Scott, JASA 76, 1981). As the chain was fitted to the same runs, the p-value
/// is too large: a rejection is more reliable than a pass. The first run and the last are truncated
/// and do not count. nullopt: too few runs.
[[nodiscard]] std::optional<double> test_runs(const std::vector<LossRun>& runs,
                                              const LossChain& chain, bool of_losses);

} // namespace hapnet::emulator::tools
